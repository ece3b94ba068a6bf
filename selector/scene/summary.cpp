#include "selector/scene/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

const char* status_name(NewtonStatus status) {
  switch (status) {
    case NewtonStatus::converged:
      return "converged";
    case NewtonStatus::interrupted:
      return "interrupted";
    case NewtonStatus::not_converged:
      break;
  }
  return "not converged";
}

const char* method_name(LinearSolverKind method) {
  return method == LinearSolverKind::cholesky ? "cholesky" : "cg";
}

/// Groups of the same association and geometry, joined over the parts.
std::vector<GroupSummary> joined(const std::vector<GroupSummary>& groups) {
  std::vector<GroupSummary> result;
  for (const GroupSummary& group : groups) {
    const auto same = std::find_if(result.begin(), result.end(), [&](const GroupSummary& other) {
      return other.association == group.association && other.geometry == group.geometry;
    });
    if (same == result.end()) {
      result.push_back(group);
    } else {
      same->num_elements += group.num_elements;
      same->num_batches += group.num_batches;
    }
  }
  return result;
}

Json associations_json(const RunSummary& summary) {
  Json list = Json::array();
  for (const GroupSummary& group : joined(summary.groups)) {
    Json entry = {{"association", group.association},
                  {"geometry", group.geometry},
                  {"elements", group.num_elements},
                  {"constants_per_element", group.num_constants},
                  {"bytes_per_element", group.bytes_per_element}};
    for (const KernelOrigin& origin : summary.kernels) {
      if (origin.association != group.association) continue;
      entry["up_to_date"] = origin.up_to_date;
      entry["generate_seconds"] = origin.generate_seconds;
      entry["compile_seconds"] = origin.compile_seconds;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json newton_json(const RunSummary& summary) {
  const NewtonResult& newton = summary.results->newton;
  Json entry = {{"status", status_name(newton.status)},
                {"method", method_name(summary.scene->solver.method)},
                {"newton_iterations", newton.iterations},
                {"cg_iterations", newton.linear_iterations},
                {"factorizations", newton.factorizations},
                {"energy_evaluations", newton.energy_evaluations},
                {"load_factor", newton.load_factor},
                {"residual", newton.residual},
                {"relative_residual", newton.relative_residual},
                {"energy", newton.energy},
                {"threads", summary.threads}};
  if (!newton.reason.empty()) entry["reason"] = newton.reason;
  return entry;
}

Json times_json(const RunSummary& summary) {
  const NewtonTimes& newton = summary.results->newton.times;
  return {{"mesh", summary.times.mesh},           {"kernels", summary.times.kernels},
          {"setup", summary.times.setup},         {"solve", summary.times.solve},
          {"solve_forces", newton.forces},        {"solve_tangents", newton.linearization},
          {"solve_linear_systems", newton.solve}, {"output", summary.times.output}};
}

Json components_json(const std::array<double, 3>& vector, std::size_t dim) {
  return std::vector<double>(vector.begin(), vector.begin() + static_cast<std::ptrdiff_t>(dim));
}

Json probes_json(const SceneResults& results, std::size_t dim) {
  Json list = Json::array();
  for (const ProbeResult& probe : results.probes) {
    list.push_back({{"name", probe.name},
                    {"nodes", probe.num_nodes},
                    {"displacement", components_json(probe.displacement, dim)},
                    {"reaction", components_json(probe.reaction, dim)}});
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

std::string kernel_text(const RunSummary& summary, const std::string& association) {
  for (const KernelOrigin& origin : summary.kernels) {
    if (origin.association != association) continue;
    if (origin.up_to_date) return "up to date";
    return fmt::format("generated {:.2f} s, compiled {:.1f} s", origin.generate_seconds,
                       origin.compile_seconds);
  }
  return "";
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
  std::string text = fmt::format("  {:<28}{:<9}{:>9}{:>11}{:>15}  {}\n", "association", "geometry",
                                 "elements", "constants", "bytes/element", "kernels");
  for (const GroupSummary& group : joined(summary.groups)) {
    text += fmt::format("  {:<28}{:<9}{:>9}{:>11}{:>15}  {}\n", group.association, group.geometry,
                        group.num_elements, group.num_constants, group.bytes_per_element,
                        kernel_text(summary, group.association));
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

std::string results_text(const RunSummary& summary) {
  const SceneResults& results = *summary.results;
  const auto dim = static_cast<std::size_t>(summary.problem->mesh.mesh.dim);
  std::string text;
  for (const ProbeResult& probe : results.probes) {
    text += fmt::format("  probe {:<13} mean displacement {} m, reaction {} N\n", probe.name,
                        vector_text(std::span(probe.displacement).first(dim), 6),
                        vector_text(std::span(probe.reaction).first(dim), 1));
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
  return text;
}

}  // namespace

std::vector<std::string> skipped_operations(const std::vector<std::string>& generated) {
  std::vector<std::string> skipped;
  for (const char* operation : {"energy", "forces", "product", "linearize", "apply", "stiffness"}) {
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
                 {"split_quadrilaterals", mesh.split_quadrilaterals}}}};
  json["associations"] = associations_json(summary);
  json["operations"] = summary.operations;
  json["skipped_operations"] = skipped_operations(summary.operations);
  if (!summary.problem->surface_loads.empty()) {
    json["surface_loads"] = surface_loads_json(*summary.problem);
  }
  json["solver"] = newton_json(summary);
  json["probes"] = probes_json(results, dim);
  if (results.curve)
    json["tip_displacement"] = components_json(results.curve->displacement.back(), dim);
  if (results.distance) {
    const std::string component = mesh.mesh.dim == 2 ? "uy" : "uz";
    json["reference"] = {{"label", summary.scene->reference->label},
                         {"mean_distance_" + component, results.distance->mean},
                         {"tip_difference_" + component, results.distance->tip}};
  }
  json["seconds"] = times_json(summary);
  json["warnings"] = summary.warnings;
  json["files"] = summary.files;
  return json;
}

std::string summary_text(const RunSummary& summary) {
  const Mesh& mesh = summary.problem->mesh.mesh;
  const NewtonResult& newton = summary.results->newton;
  std::string text = fmt::format("{}\n  mesh                {} elements, {} nodes\n",
                                 summary.scene->title, mesh.num_elements(), mesh.num_nodes());
  text += associations_text(summary);
  text += surface_loads_text(*summary.problem);
  text += fmt::format("  solver              {}: {}, {} Newton iterations, ",
                      method_name(summary.scene->solver.method), status_name(newton.status),
                      newton.iterations);
  text += summary.scene->solver.method == LinearSolverKind::cholesky
              ? fmt::format("{} factorizations\n", newton.factorizations)
              : fmt::format("{} CG iterations\n", newton.linear_iterations);
  if (!newton.reason.empty()) text += fmt::format("                      {}\n", newton.reason);
  text += results_text(summary);
  text += fmt::format("  skipped             operations that this solver does not call: {}\n",
                      join(skipped_operations(summary.operations), ", "));
  text += fmt::format(
      "  times               mesh {:.2f} s, kernels {:.2f} s, setup {:.2f} s, solve {:.2f} s "
      "(forces {:.2f}, tangents and their products {:.2f}, rest of linear systems {:.2f}), output "
      "{:.2f} s\n",
      summary.times.mesh, summary.times.kernels, summary.times.setup, summary.times.solve,
      newton.times.forces, newton.times.linearization, newton.times.solve, summary.times.output);
  text += fmt::format("  files               {} in {}\n", join(summary.files, ", "),
                      summary.folder.string());
  return text;
}

}  // namespace elastogen::selector
