#include "selector/scene/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "selector/io/si_prefix.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

const char* status_name(MotionStatus status) {
  switch (status) {
    case MotionStatus::at_rest:
      return "at rest";
    case MotionStatus::end_of_time:
      return "end of time";
    case MotionStatus::interrupted:
      return "interrupted";
    case MotionStatus::failed:
      break;
  }
  return "failed";
}

/// Groups of the same association and geometry, joined over the parts.
std::vector<GroupSummary> joined(const std::vector<GroupSummary>& groups) {
  std::vector<GroupSummary> result;
  for (const GroupSummary& group : groups) {
    const auto same = std::find_if(result.begin(), result.end(), [&](const GroupSummary& other) {
      return other.association == group.association && other.geometry == group.geometry &&
             other.scalar == group.scalar;
    });
    if (same == result.end()) {
      result.push_back(group);
    } else {
      const std::size_t bytes = same->bytes_per_element * same->num_elements +
                                group.bytes_per_element * group.num_elements;
      same->num_elements += group.num_elements;
      same->num_batches += group.num_batches;
      same->num_shapes += group.num_shapes;
      same->bytes_per_element = bytes / same->num_elements;
    }
  }
  return result;
}

/// Null for groups of no kernels in the list.
const KernelOrigin* origin_of(const GroupSummary& group, const std::vector<KernelOrigin>& kernels) {
  const auto found = std::find_if(kernels.begin(), kernels.end(), [&](const KernelOrigin& origin) {
    return origin.association == group.association && origin.scalar == group.scalar;
  });
  return found == kernels.end() ? nullptr : &*found;
}

Json associations_json(const RunSummary& summary) {
  Json list = Json::array();
  for (const GroupSummary& group : joined(summary.groups)) {
    Json entry = {{"association", group.association},
                  {"geometry", group.geometry},
                  {"scalar", group.scalar},
                  {"lanes", group.lanes},
                  {"instruction_set", group.instruction_set},
                  {"elements", group.num_elements},
                  {"shapes", group.num_shapes},
                  {"constants_per_element", group.num_constants},
                  {"bytes_per_element", group.bytes_per_element}};
    if (const KernelOrigin* origin = origin_of(group, summary.kernels)) {
      entry["up_to_date"] = origin->up_to_date;
      entry["generate_seconds"] = origin->generate_seconds;
      entry["compile_seconds"] = origin->compile_seconds;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

/// Why this method: chosen, said by the scene, or fallen back to.
std::string method_reason(const RunSummary& summary, LinearSolverKind method) {
  const SolverChoice& choice = summary.problem->solver;
  if (method == choice.kind) return choice.reason;
  return fmt::format("{} got nowhere, though chosen: {}", solver_name(choice.kind), choice.reason);
}

Json newton_json(const RunSummary& summary) {
  const NewtonResult& newton = *summary.newton;
  Json entry = {{"status", status_name(newton.status)},
                {"method", solver_name(newton.method)},
                {"method_reason", method_reason(summary, newton.method)},
                {"tangent", tangent_product_name(summary.tangent)},
                {"precision", precision_name(summary.scene->solver.precision)},
                {"newton_iterations", newton.iterations},
                {"cg_iterations", newton.linear_iterations},
                {"factorizations", newton.factorizations},
                {"projections", newton.projections},
                {"energy_evaluations", newton.energy_evaluations},
                {"load_factor", newton.load_factor},
                {"residual", newton.residual},
                {"relative_residual", newton.relative_residual},
                {"tolerance", summary.scene->solver.tolerance},
                {"stability", stability_name(newton.stability)},
                {"energy", newton.energy},
                {"threads", summary.threads}};
  if (newton.negative_eigenvalues) entry["negative_eigenvalues"] = *newton.negative_eigenvalues;
  if (!newton.reason.empty()) entry["reason"] = newton.reason;
  return entry;
}

Json motion_json(const RunSummary& summary) {
  const MotionPlan& plan = *summary.plan;
  const MotionResult& motion = *summary.motion;
  Json entry = {{"status", status_name(motion.status)},
                {"scheme", scheme_name(plan.options.scheme)},
                {"precision", precision_name(summary.scene->solver.precision)},
                {"step", plan.options.step},
                {"steps", motion.steps},
                {"planned_steps", plan.num_steps},
                {"time", motion.time},
                {"kinetic_energy", summary.results->state.kinetic_energy},
                {"steps_made", motion.steps_made},
                {"force_evaluations", motion.force_evaluations},
                {"threads", summary.threads}};
  if (plan.critical_step) {
    entry["critical_step"] = *plan.critical_step;
  } else {
    entry["method"] = solver_name(motion.method);
    entry["method_reason"] = method_reason(summary, motion.method);
    entry["tangent"] = tangent_product_name(summary.tangent);
    entry["cg_iterations"] = motion.linear_iterations;
    entry["halved_steps"] = motion.halvings;
  }
  if (!motion.reason.empty()) entry["reason"] = motion.reason;
  return entry;
}

Json times_json(const RunSummary& summary) {
  Json times = {{"mesh", summary.times.mesh},
                {"kernels", summary.times.kernels},
                {"setup", summary.times.setup},
                {"solve", summary.times.solve}};
  if (summary.newton) {
    times["solve_forces"] = summary.newton->times.forces;
    times["solve_tangents"] = summary.newton->times.linearization;
    times["solve_linear_systems"] = summary.newton->times.solve;
  }
  times["output"] = summary.times.output;
  return times;
}

/// Bytes of grouped constants that congruent elements need not have.
std::size_t shared_bytes(const std::vector<GroupSummary>& groups) {
  std::size_t bytes = 0;
  for (const GroupSummary& group : groups) {
    const std::size_t size = group.scalar == "float" ? sizeof(float) : sizeof(double);
    bytes += (group.num_elements - group.num_shapes) *
             static_cast<std::size_t>(group.num_constants) * size;
  }
  return bytes;
}

Json skipped_json(const RunSummary& summary) {
  const SkippedWork& skipped = summary.skipped;
  return {{"elements_at_rest", skipped.elements_at_rest},
          {"element_passes", skipped.element_passes},
          {"forces_kept", skipped.slept},
          {"seconds_saved", skipped.seconds_saved},
          {"shared_constants_bytes", shared_bytes(summary.groups)}};
}

Json components_json(const std::array<double, 3>& vector, std::size_t dim) {
  return std::vector<double>(vector.begin(), vector.begin() + static_cast<std::ptrdiff_t>(dim));
}

/// A number, or one for each component; what is no number is null.
Json field_json(const FieldArray& field) {
  if (field.shape.components.empty()) return field.values.front();
  Json components;
  for (std::size_t c = 0; c < field.values.size(); ++c) {
    components[field.shape.components[c]] = field.values[c];
  }
  return components;
}

Json probes_json(const SceneResults& results, std::size_t dim) {
  Json list = Json::array();
  for (const ProbeResult& probe : results.probes) {
    list.push_back({{"name", probe.name},
                    {"nodes", probe.num_nodes},
                    {"displacement", components_json(probe.displacement, dim)},
                    {"reaction", components_json(probe.reaction, dim)},
                    {"moment", dim == 2 ? Json(probe.moment[2]) : Json(probe.moment)}});
    for (const FieldArray& field : probe.fields) {
      list.back()["fields"][field.shape.name] = field_json(field);
    }
  }
  return list;
}

Json surface_loads_json(const Problem& problem) {
  Json list = Json::array();
  for (const SurfaceLoad& load : problem.surface_loads) {
    list.push_back({{"load", load.description},
                    {"faces", load.faces.size()},
                    {"area", load.area},
                    {"resultant", load.resultant}});
  }
  return list;
}

std::string kernel_text(const KernelOrigin* origin) {
  if (!origin) return "";
  if (origin->up_to_date) return "up to date";
  return fmt::format("generated {:.2f} s, compiled {:.1f} s", origin->generate_seconds,
                     origin->compile_seconds);
}

/// What rounds to zero is printed without a sign.
std::string vector_text(std::span<const double> vector, int precision) {
  std::vector<double> shown(vector.begin(), vector.end());
  for (double& component : shown) {
    if (std::abs(component) < 0.5 * std::pow(10.0, -precision)) component = 0;
  }
  std::vector<std::string> components;
  for (const double component : shown) {
    components.push_back(fmt::format("{:.{}f}", component, precision));
  }
  return fmt::format("[{}]", join(components, ", "));
}

std::string associations_text(const RunSummary& summary) {
  std::string text =
      fmt::format("  {:<31} {:<9}{:<7}{:>9}{:>8}{:>11}{:>15}  {}\n", "association", "geometry",
                  "scalar", "elements", "shapes", "constants", "bytes/element", "kernels");
  for (const GroupSummary& group : joined(summary.groups)) {
    text += fmt::format("  {:<31} {:<9}{:<7}{:>9}{:>8}{:>11}{:>15}  {}\n", group.association,
                        group.geometry, group.scalar, group.num_elements, group.num_shapes,
                        group.num_constants, group.bytes_per_element,
                        kernel_text(origin_of(group, summary.kernels)));
  }
  return text;
}

std::string surface_loads_text(const Problem& problem) {
  std::string text;
  for (const SurfaceLoad& load : problem.surface_loads) {
    text += fmt::format(
        "  dead load           {}: {} faces, {:.6g} m^2 at rest, resultant {} N; keeps its "
        "direction\n",
        load.description, load.faces.size(), load.area, vector_text(load.resultant, 1));
  }
  return text;
}

std::string moduli_text(const MeasuredModuli& moduli) {
  std::string text = fmt::format("  measured            at a strain of {:.3g}: ", moduli.strain);
  if (moduli.young) text += fmt::format("E = {:.6g} Pa", *moduli.young);
  if (moduli.young && moduli.poisson) text += ", ";
  if (moduli.poisson) text += fmt::format("nu = {:.6f}", *moduli.poisson);
  if (moduli.strain == 0) text += "nothing: the bar's length did not change";
  return text + "\n";
}

std::string results_text(const RunSummary& summary) {
  const SceneResults& results = *summary.results;
  const auto dim = static_cast<std::size_t>(summary.problem->mesh.mesh.dim);
  std::string text;
  for (const ProbeResult& probe : results.probes) {
    text += fmt::format("  probe {:<13} mean displacement {} m, reaction {} N\n", probe.name,
                        vector_text(std::span(probe.displacement).first(dim), 6),
                        vector_text(std::span(probe.reaction).first(dim), 1));
  }
  if (const auto& greatest = results.von_mises) {
    const SiPrefix prefix = si_prefix(greatest->value);
    text += fmt::format(
        "  von Mises stress    at most {:.6g} {}Pa at quadrature points, in element {}\n",
        prefix.factor * greatest->value, prefix.symbol,
        summary.problem->mesh.mesh.element_number(greatest->element));
  }
  if (results.curve) {
    text += fmt::format("  tip deflection      {} = {:.6f} m, u_x = {:.6f} m\n",
                        results.curve->deflection_name(),
                        results.curve->deflection(results.curve->size() - 1),
                        results.curve->displacement.back()[0]);
  }
  if (results.distance) {
    text += fmt::format(
        "  distance            mean |{} - {}| = {:.6f} m over the sections; tip {:+.6f} m\n",
        results.curve->deflection_name(), summary.scene->reference->label, results.distance->mean,
        results.distance->tip);
  }
  if (results.field_distance) {
    text += fmt::format(
        "  distance            |u - {}|: mean {:.6f} m over the nodes, from {:.6f} to {:.6f} m\n",
        summary.scene->reference->label, results.field_distance->mean,
        results.field_distance->minimum, results.field_distance->maximum);
  }
  if (results.moduli) text += moduli_text(*results.moduli);
  return text;
}

std::string newton_text(const RunSummary& summary) {
  const NewtonResult& newton = *summary.newton;
  std::string text =
      fmt::format("  solver              {}: {}, {} Newton iterations, ",
                  solver_name(newton.method), status_name(newton.status), newton.iterations);
  std::vector<std::string> counts;
  if (newton.linear_iterations > 0 || newton.factorizations == 0) {
    counts.push_back(fmt::format("{} CG iterations ({} products)", newton.linear_iterations,
                                 tangent_product_name(summary.tangent)));
  }
  if (newton.factorizations > 0) {
    counts.push_back(fmt::format("{} factorizations", newton.factorizations));
  }
  text += join(counts, ", ");
  if (newton.projections > 0) text += fmt::format(", {} projections", newton.projections);
  if (newton.load_steps > 1) text += fmt::format(", {} load steps", newton.load_steps);
  text += fmt::format("\n                      {}: {}\n", solver_name(newton.method),
                      method_reason(summary, newton.method));
  if (in_equilibrium(newton.status)) {
    text +=
        fmt::format("                      equilibrium: {}\n", stability_name(newton.stability));
  }
  return text;
}

std::string motion_text(const RunSummary& summary) {
  const MotionPlan& plan = *summary.plan;
  const MotionResult& motion = *summary.motion;
  std::string text = fmt::format(
      "  motion              {}: {} after {} steps of {:.4g} s, t = {:.6g} s, kinetic energy "
      "{:.3g} "
      "J\n                      ",
      scheme_name(plan.options.scheme), status_name(motion.status), motion.steps, plan.options.step,
      motion.time, summary.results->state.kinetic_energy);
  const auto made = static_cast<double>(std::max<std::int64_t>(motion.steps_made, 1));
  if (plan.critical_step) {
    text += fmt::format("critical step {:.4g} s", *plan.critical_step);
  } else {
    text += fmt::format("{}, {:.1f} CG iterations per step ({} products), {} steps halved",
                        solver_name(motion.method),
                        static_cast<double>(motion.linear_iterations) / made,
                        tangent_product_name(summary.tangent), motion.halvings);
  }
  return text + fmt::format("; {:.3g} ms per step\n", 1000 * motion.seconds / made);
}

std::string skipped_text(const RunSummary& summary) {
  const SkippedWork& skipped = summary.skipped;
  std::vector<std::string> lines = {"operations that this run does not call: " +
                                    join(skipped_operations(summary.operations), ", ")};
  if (const std::size_t bytes = shared_bytes(summary.groups); bytes > 0) {
    lines.push_back(fmt::format("constants of congruent elements: {:.3g} MB",
                                1e-6 * static_cast<double>(bytes)));
  }
  if (skipped.elements_at_rest > 0) {
    lines.push_back(
        fmt::format("{} elements at rest between held nodes", skipped.elements_at_rest));
  }
  if (skipped.slept > 0) {
    lines.push_back(fmt::format(
        "forces of sleeping elements: {:.1f} % of {} in all",
        100 * static_cast<double>(skipped.slept) / static_cast<double>(skipped.element_passes),
        skipped.element_passes));
  }
  if (skipped.elements_at_rest > 0 || skipped.slept > 0) {
    lines.push_back(skipped.seconds_saved >= 0
                        ? fmt::format("about {:.2g} s saved", skipped.seconds_saved)
                        : fmt::format("about {:.2g} s lost: finding out what sleeps took longer",
                                      -skipped.seconds_saved));
  }
  std::string text = "  skipped             " + join(lines, "\n                      ") + "\n";
  if (summary.reordered) {
    text += "  order               the mesh is scattered: elements are taken along a curve\n";
  }
  return text;
}

std::string times_text(const RunSummary& summary) {
  std::string text = fmt::format(
      "  times               mesh {:.2f} s, kernels {:.2f} s, setup {:.2f} s, solve {:.2f} s",
      summary.times.mesh, summary.times.kernels, summary.times.setup, summary.times.solve);
  if (summary.newton) {
    const NewtonTimes& newton = summary.newton->times;
    text += fmt::format(
        " (forces {:.2f}, tangents and their products {:.2f}, rest of linear systems {:.2f})",
        newton.forces, newton.linearization, newton.solve);
  }
  return text + fmt::format(", output {:.2f} s\n", summary.times.output);
}

}  // namespace

std::vector<std::string> skipped_operations(const std::vector<std::string>& generated) {
  std::vector<std::string> skipped;
  for (const char* operation :
       {"energy", "forces", "product", "linearize", "apply", "stiffness", "stress"}) {
    if (std::find(generated.begin(), generated.end(), operation) == generated.end()) {
      skipped.emplace_back(operation);
    }
  }
  return skipped;
}

Json summary_json(const RunSummary& summary) {
  const SceneMesh& mesh = summary.problem->mesh;
  const SceneResults& results = *summary.results;
  const auto dim = static_cast<std::size_t>(mesh.mesh.dim);
  Json json = {{"title", summary.scene->title},
               {"scene", summary.scene->file.filename().string()},
               {"mesh",
                {{"nodes", mesh.mesh.num_nodes()},
                 {"elements", mesh.mesh.num_elements()},
                 {"split_quadrilaterals", mesh.split_quadrilaterals},
                 {"unequal_faces", mesh.unequal_faces}}}};
  json["associations"] = associations_json(summary);
  json["operations"] = summary.operations;
  json["skipped_operations"] = skipped_operations(summary.operations);
  json["skipped"] = skipped_json(summary);
  json["reordered"] = summary.reordered;
  if (!summary.problem->surface_loads.empty()) {
    json["surface_loads"] = surface_loads_json(*summary.problem);
  }
  if (summary.newton) json["solver"] = newton_json(summary);
  if (summary.motion) json["motion"] = motion_json(summary);
  if (summary.resumed_from) {
    json["resumed_from"] = {{"step", summary.resumed_from->step},
                            {summary.motion ? "time" : "load_factor", summary.resumed_from->time}};
  }
  json["probes"] = probes_json(results, dim);
  if (const auto& greatest = results.von_mises) {
    json["greatest_von_mises"] = {{"value", greatest->value}, {"element", greatest->element}};
  }
  if (results.curve)
    json["tip_displacement"] = components_json(results.curve->displacement.back(), dim);
  if (results.distance) {
    const std::string component = mesh.mesh.dim == 2 ? "uy" : "uz";
    json["reference"] = {{"label", summary.scene->reference->label},
                         {"mean_distance_" + component, results.distance->mean},
                         {"tip_difference_" + component, results.distance->tip}};
  }
  if (results.field_distance) {
    json["reference"] = {{"label", summary.scene->reference->label},
                         {"mean_distance", results.field_distance->mean},
                         {"min_distance", results.field_distance->minimum},
                         {"max_distance", results.field_distance->maximum}};
  }
  if (results.moduli) {
    json["measured"] = {{"strain", results.moduli->strain}};
    if (results.moduli->young) json["measured"]["young"] = *results.moduli->young;
    if (results.moduli->poisson) json["measured"]["poisson"] = *results.moduli->poisson;
  }
  json["seconds"] = times_json(summary);
  json["warnings"] = summary.warnings;
  json["files"] = summary.files;
  return json;
}

std::string summary_text(const RunSummary& summary) {
  const Mesh& mesh = summary.problem->mesh.mesh;
  std::string text = fmt::format("{}\n  mesh                {} elements, {} nodes\n",
                                 summary.scene->title, mesh.num_elements(), mesh.num_nodes());
  text += associations_text(summary);
  text += surface_loads_text(*summary.problem);
  text += summary.newton ? newton_text(summary) : motion_text(summary);
  const std::string& reason = summary.newton ? summary.newton->reason : summary.motion->reason;
  if (!reason.empty()) text += fmt::format("                      {}\n", reason);
  if (summary.resumed_from) {
    text += fmt::format("  resumed             from step {}\n", summary.resumed_from->step);
  }
  text += results_text(summary);
  text += skipped_text(summary);
  text += times_text(summary);
  text += fmt::format("  files               {} in {}\n", join(summary.files, ", "),
                      summary.folder.string());
  return text;
}

}  // namespace elastogen::selector
