#include "selector/commands/run.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>

#include "runtime/error.h"
#include "selector/io/atomic_file.h"
#include "selector/io/curve_picture.h"
#include "selector/io/deformed_picture.h"
#include "selector/io/gnuplot.h"
#include "selector/io/vtu.h"
#include "selector/scene/interrupt.h"
#include "selector/scene/located_error.h"
#include "selector/scene/summary.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::string cells;
  bool json = false;
};

/// Seconds since the last call, or since construction.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> elapsed = now - start_;
    start_ = now;
    return elapsed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// "48x8x8", in the plane "48x8"
std::array<int, 3> parse_cells(const std::string& text, int dim) {
  std::array<int, 3> cells{};
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto count = static_cast<std::size_t>(dim);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [next, error] = std::from_chars(at, end, cells[i]);
    const bool separated = i + 1 < count ? next < end && *next == 'x' : next == end;
    if (error != std::errc() || !separated || cells[i] < 1) {
      throw InputError(fmt::format(
          "--cells {}: must be cells along {}", text,
          dim == 2 ? "x and y, as in 48x8: the bar is plane" : "x, y and z, as in 48x8x8"));
    }
    at = next + 1;
  }
  return cells;
}

Scene read_scene_with_options(const RunOptions& options) {
  Scene scene = read_scene(options.scene);
  if (!options.cells.empty()) {
    if (!scene.bar) {
      throw InputError(fmt::format("--cells {}: the scene {} has no [bar] to divide", options.cells,
                                   options.scene.string()));
    }
    scene.bar->cells = parse_cells(options.cells, scene.dim);
  }
  return scene;
}

/// Kernels of the scene's associations, each made once.
std::map<symgen::AssociationId, LoadedKernels> load_kernels(
    const Problem& problem, const std::vector<std::string>& operations, const Context& context) {
  std::vector<KernelRequest> requests;
  std::map<symgen::AssociationId, std::size_t> position;
  for (const SceneMesh::Block& block : problem.mesh.blocks) {
    if (!position.emplace(block.association, requests.size()).second) continue;
    symgen::Instantiation what;
    what.operations = operations;
    requests.push_back({block.association, problem.laws.at(block.association.law), what});
  }
  KernelLoader loader(context.loader_options());
  std::vector<LoadedKernels> loaded = loader.load(requests);
  std::map<symgen::AssociationId, LoadedKernels> kernels;
  for (auto& [id, index] : position) kernels.emplace(id, std::move(loaded[index]));
  return kernels;
}

std::string progress_line(const NewtonProgress& progress) {
  std::string line = fmt::format(
      "newton {:3}  residual {:.3e} (relative {:.1e})  potential {:.8e} J", progress.iteration,
      progress.residual, progress.relative_residual, progress.potential);
  if (progress.iteration > 0) line += fmt::format("  step {:.3g}", progress.step);
  if (progress.linear_iterations > 0) line += fmt::format("  cg {}", progress.linear_iterations);
  if (progress.shift > 0) line += fmt::format("  shift {:.1e}", progress.shift);
  if (progress.load_factor < 1) line += fmt::format("  load {:.3g}", progress.load_factor);
  return line;
}

/// Solves from rest; Ctrl-C ends it at the next iteration.
NewtonResult solve(const Scene& scene, const Problem& problem, Model& model, Vector& displacement,
                   const Context& context) {
  const InterruptGuard interrupt;
  NewtonOptions options;
  options.linear_solver.kind = scene.solver.method;
  options.tolerance = scene.solver.tolerance;
  options.max_iterations = scene.solver.max_iterations;
  options.load_steps = scene.solver.load_steps;
  options.on_iteration = [&](const NewtonProgress& progress) {
    context.tell(progress_line(progress));
    return !interrupt.interrupted();
  };
  displacement = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  return solve_static(model, problem.constraints, make_load(scene, problem, model), options,
                      displacement);
}

/// Which association and region each element has.
std::vector<ElementLabels> element_labels(const SceneMesh& mesh) {
  ElementLabels associations{"association", {}, {}}, regions{"region", {}, mesh.mesh.region_names};
  std::map<std::string, std::int32_t> numbers;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const std::string name = mesh.blocks[b].association.text();
    const auto number = static_cast<std::int32_t>(numbers.size());
    const auto [entry, is_new] = numbers.emplace(name, number);
    if (is_new) associations.names.push_back(name);
    const ElementBlock& block = mesh.mesh.blocks[b];
    associations.values.insert(associations.values.end(), block.num_elements(), entry->second);
    regions.values.insert(regions.values.end(), block.region.begin(), block.region.end());
  }
  return {associations, regions};
}

std::span<const double> values_of(const Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

/// Writes a picture; one that cannot be drawn costs a warning, not the results.
template <class Draw>
void try_picture(const std::string& name, RunSummary& summary, const Draw& draw) {
  try {
    draw(summary.folder / name);
    summary.files.push_back(name);
  } catch (const WorkError& error) {
    summary.warnings.push_back(error.what());
  }
}

void write_pictures(RunSummary& summary) {
  if (!have_gnuplot()) {
    summary.warnings.push_back(
        "gnuplot is not installed, so there are no pictures (package gnuplot-nox)");
    return;
  }
  const Scene& scene = *summary.scene;
  const SceneResults& results = *summary.results;
  try_picture("deformed.png", summary, [&](const std::filesystem::path& file) {
    draw_deformed(file, summary.problem->mesh.mesh, values_of(results.displacement), scene.title);
  });
  if (!results.curve) return;
  std::optional<NamedCurve> reference;
  if (summary.problem->reference) {
    reference = NamedCurve{scene.reference->label, *summary.problem->reference};
  }
  try_picture("deflection.png", summary, [&](const std::filesystem::path& file) {
    draw_curve(file, *results.curve, reference, scene.title);
  });
}

/// Writes what the scene asks for; each file is whole as soon as it is there.
void write_results(RunSummary& summary) {
  const OutputSettings& output = summary.scene->output;
  const SceneResults& results = *summary.results;
  if (output.vtu) {
    VtuFields fields;
    fields.nodes = {{"displacement", values_of(results.displacement)},
                    {"internal_forces", values_of(results.newton.internal_forces)},
                    {"reactions", values_of(results.newton.reactions)}};
    fields.elements = {{"energy_density", results.energy_density}};
    fields.labels = element_labels(summary.problem->mesh);
    write_vtu(summary.folder / "result.vtu", summary.problem->mesh.mesh, fields);
    summary.files.push_back("result.vtu");
  }
  if (output.curve && results.curve) {
    write_curve_csv(summary.folder / "deflection.csv", *results.curve,
                    summary.scene->title + ": mean displacement of each section [m]");
    summary.files.push_back("deflection.csv");
  }
  if (output.picture) write_pictures(summary);
  summary.files.push_back("summary.json");
}

std::vector<std::string> mesh_warnings(const SceneMesh& mesh) {
  std::vector<std::string> warnings = mesh.notes;
  if (mesh.split_quadrilaterals > 0) {
    warnings.push_back(
        fmt::format("{} quadrilateral faces meet triangles of neighbours that split them: the "
                    "displacement is not continuous across them (thesis, figure 6.19)",
                    mesh.split_quadrilaterals));
  }
  return warnings;
}

int exit_status(NewtonStatus status) {
  switch (status) {
    case NewtonStatus::converged:
      return 0;
    case NewtonStatus::interrupted:
      return exit_interrupted;
    case NewtonStatus::not_converged:
      break;
  }
  return 1;
}

int run(const RunOptions& options, const Context& context) {
  Stopwatch watch;
  RunSummary summary;
  const auto warn = [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };

  const Scene scene = read_scene_with_options(options);
  const Problem problem = prepare(scene, context.law_folders());
  const Mesh& mesh = problem.mesh.mesh;
  context.tell(fmt::format("mesh: {} elements, {} nodes", mesh.num_elements(), mesh.num_nodes()));
  summary.warnings = mesh_warnings(problem.mesh);
  for (const std::string& warning : summary.warnings) warn(warning);
  summary.folder =
      options.out.empty() ? std::filesystem::path("out") / scene.file.stem() : options.out;
  check_can_be_written(summary.folder);
  summary.times.mesh = watch.lap();

  summary.operations = operations_of(scene.solver.method, problem.constraints);
  const auto kernels = load_kernels(problem, summary.operations, context);
  std::vector<const KernelTable<double>*> tables;
  for (const SceneMesh::Block& block : problem.mesh.blocks) {
    tables.push_back(&kernels.at(block.association).table<double>());
  }
  for (const auto& [id, loaded] : kernels) {
    const KernelBuildReport& report = loaded.report();
    summary.kernels.push_back(
        {report.association, report.up_to_date, report.generate_seconds, report.compile_seconds});
  }
  summary.times.kernels = watch.lap();

  const int threads = context.threads > 0 ? context.threads : scene.solver.threads;
  Model model = with_location(scene.file.string(), "mesh",
                              [&] { return make_model(problem, tables, threads); });
  summary.groups = model.groups();
  summary.threads = model.num_threads();
  create_folder(summary.folder);
  summary.times.setup = watch.lap();
  context.tell(fmt::format("setup: grouped constants of {} elements in {:.2f} s, {} threads",
                           model.num_elements(), summary.times.setup, summary.threads));

  Vector displacement;
  NewtonResult newton = solve(scene, problem, model, displacement, context);
  const SceneResults results =
      collect_results(problem, model, std::move(newton), std::move(displacement));
  summary.times.solve = watch.lap();

  summary.scene = &scene;
  summary.problem = &problem;
  summary.results = &results;
  const std::size_t warned = summary.warnings.size();
  write_results(summary);
  for (std::size_t i = warned; i < summary.warnings.size(); ++i) warn(summary.warnings[i]);
  summary.times.output = watch.lap();
  const std::string json = summary_json(summary).dump(2) + "\n";
  write_text_file(summary.folder / "summary.json", json);

  fmt::print("{}", options.json ? json : summary_text(summary));
  if (results.newton.status != NewtonStatus::converged) {
    fmt::print(stderr, "error: no equilibrium: {}; what was computed is in {}\n",
               results.newton.reason, summary.folder.string());
  }
  return exit_status(results.newton.status);
}

}  // namespace

void add_run_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand(
      "run", "Simulate a scene (docs/scene.md): makes its kernels, solves, writes results");
  command->footer(
      "Writes a VTU file, a deflection curve, pictures and summary.json, as the scene asks.\n"
      "Exit status: 0 converged; 1 not converged, or the work failed; 2 the scene or the call is\n"
      "wrong, nothing is written; 130 ended by Ctrl-C. What Newton reached is always written.\n"
      "Examples:\n"
      "  elastogen run scenes/mixed_beam.toml --out out/mixed_beam\n"
      "  elastogen run scenes/beam_hexa8.toml --cells 48x8x8 --threads 2 --json");
  command->add_option("SCENE", options->scene, "Scene file, TOML")->required();
  command->add_option("--out", options->out, "Folder for results; default out/NAME_OF_THE_SCENE")
      ->type_name("DIR");
  command
      ->add_option("--cells", options->cells,
                   "Divide the scene's bar differently: NXxNYxNZ, as in 48x8x8; NXxNY in the plane")
      ->type_name("CELLS");
  command->add_flag("--json", options->json, "Print the summary as JSON");
  command->callback([options, &context] {
    context.action = [options, &context] { return run(*options, context); };
  });
}

}  // namespace elastogen::selector
