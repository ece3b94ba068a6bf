#include "selector/commands/run.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "runtime/error.h"
#include "selector/io/atomic_file.h"
#include "selector/scene/fingerprint.h"
#include "selector/scene/interrupt.h"
#include "selector/scene/located_error.h"
#include "selector/scene/model_warnings.h"
#include "selector/scene/solver_warnings.h"
#include "selector/scene/static_run.h"
#include "selector/scene/summary.h"
#include "selector/scene/write_results.h"
#include "selector/support/files.h"
#include "selector/support/temporary_file.h"

namespace elastogen::selector {
namespace {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::string cells;
  bool resume = false;
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

struct SceneKernels {
  std::vector<LoadedKernels> loaded;  ///< hold the tables
  std::vector<BlockKernels> of_block;
};

/// Kernels of the scene's associations, each made once in each precision.
SceneKernels load_kernels(const Problem& problem, const std::vector<std::string>& operations,
                          Precision precision, const Context& context) {
  const OperationsByPrecision divided = divide_operations(operations, precision);
  std::vector<KernelRequest> requests;
  std::map<symgen::AssociationId, std::size_t> position;
  for (const SceneMesh::Block& block : problem.mesh.blocks) {
    if (!position.emplace(block.association, requests.size()).second) continue;
    KernelRequest request = {block.association, problem.laws.at(block.association.law), {}};
    request.what.operations = divided.in_double;
    requests.push_back(request);
    if (precision == Precision::double_precision) continue;
    request.what.operations = divided.in_single;
    request.what.single_precision = true;
    requests.push_back(request);
  }
  KernelLoader loader(context.loader_options());
  SceneKernels kernels{loader.load(requests), {}};
  for (const SceneMesh::Block& block : problem.mesh.blocks) {
    const std::size_t at = position.at(block.association);
    BlockKernels tables{&kernels.loaded[at].table<double>(), nullptr};
    if (precision != Precision::double_precision) {
      tables.in_single = &kernels.loaded[at + 1].table<float>();
    }
    kernels.of_block.push_back(tables);
  }
  return kernels;
}

std::vector<std::string> mesh_warnings(const SceneMesh& mesh) {
  std::vector<std::string> warnings = mesh.notes;
  if (mesh.split_quadrilaterals > 0) {
    warnings.push_back(
        fmt::format("{} quadrilateral faces meet triangles of neighbours that split them: the "
                    "displacement is not continuous across them (thesis, figure 6.19)",
                    mesh.split_quadrilaterals));
  }
  if (mesh.unequal_faces > 0) {
    warnings.push_back(
        fmt::format("{} faces meet faces of the same corners but of other nodes between them, as "
                    "where linear elements lie beside quadratic ones: the displacement is not "
                    "continuous across them",
                    mesh.unequal_faces));
  }
  return warnings;
}

/// The checkpoint that the run shall go on from.
std::optional<Checkpoint> find_checkpoint(const RunOptions& options, const Scene& scene,
                                          const std::filesystem::path& folder) {
  if (!options.resume) return std::nullopt;
  if (!scene.has_steps()) {
    throw InputError(fmt::format(
        "--resume: {} has no steps to go on from: neither [dynamics] nor load_steps of 2 or more",
        scene.file.string()));
  }
  if (!std::filesystem::exists(checkpoint_file(folder))) {
    throw InputError(fmt::format("--resume: there is no {}: start without it",
                                 checkpoint_file(folder).string()));
  }
  return read_checkpoint(checkpoint_file(folder));
}

void check_fingerprint(const std::string& fingerprint, const Checkpoint& checkpoint,
                       const std::filesystem::path& folder) {
  if (checkpoint.fingerprint == fingerprint) return;
  throw InputError(fmt::format(
      "--resume: {} is of another problem: mesh, law, material, constraint, load, scheme, step or "
      "tolerance have changed since (only the end of a run and what it writes may): start without "
      "--resume",
      checkpoint_file(folder).string()));
}

/// Why a resumed run may not come to the same bits as one that was not interrupted.
std::vector<std::string> resume_warnings(const Scene& scene, const Problem& problem,
                                         const Checkpoint& start, int threads) {
  std::vector<std::string> warnings;
  if (start.threads != threads) {
    warnings.push_back(fmt::format(
        "computed with {} threads so far and with {} from here: the last bits will differ from a "
        "run that was not interrupted",
        start.threads, threads));
  }
  const LinearSolverKind method =
      start.motion && start.motion->fell_back ? LinearSolverKind::cholesky_cg : problem.solver.kind;
  if (scene.dynamics && keeps_factors(method)) {
    warnings.push_back(fmt::format(
        "the factor that '{}' had is not kept: from here results agree with those of a run that "
        "was not interrupted to the linear tolerance, not to the last bit",
        solver_name(method)));
  }
  if (scene.skip.sleep.motion > 0) {
    warnings.emplace_back(
        "everything is awake from here: results agree with those of a run that was not interrupted "
        "to what skip.sleep.motion allows, not to the last bit");
  }
  return warnings;
}

/// Makes the run's steps, and fills in what came of it.
BodyState make_steps(const Scene& scene, const Problem& problem, Model& model, Recorder& recorder,
                     const Checkpoint* start, const Context& context, RunSummary& summary) {
  const InterruptGuard interrupt;
  const RunHooks hooks = {[&](const std::string& line) { context.tell(line); },
                          [&] { return interrupt.interrupted(); }};
  BodyState end;
  if (scene.dynamics) {
    summary.motion = run_motion(scene, problem, model, *summary.plan, recorder, start, hooks, end);
  } else {
    summary.newton = run_static(scene, problem, model, recorder, start, hooks, end);
  }
  return end;
}

/// The exit status; says on standard error what went wrong.
int report_end(const RunSummary& summary) {
  const auto tell = [&](const std::string& text) {
    fmt::print(stderr, "error: {}; what was computed is in {}{}\n", text, summary.folder.string(),
               summary.scene->has_steps() ? ", and --resume goes on from there" : "");
  };
  const bool interrupted = summary.motion ? summary.motion->status == MotionStatus::interrupted
                                          : summary.newton->status == NewtonStatus::interrupted;
  if (interrupted) {
    tell("interrupted");
    return exit_interrupted;
  }
  if (summary.motion && summary.motion->status == MotionStatus::failed) {
    tell(summary.motion->reason);
    return 1;
  }
  if (summary.newton && !in_equilibrium(summary.newton->status)) {
    tell("no equilibrium: " + summary.newton->reason);
    return 1;
  }
  return 0;
}

int run(const RunOptions& options, const Context& context) {
  Stopwatch watch;
  RunSummary summary;
  const auto warn = [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };

  const Scene scene = read_scene_with_options(options);
  summary.folder =
      options.out.empty() ? std::filesystem::path("out") / scene.file.stem() : options.out;
  const std::optional<Checkpoint> start = find_checkpoint(options, scene, summary.folder);
  const Problem problem = prepare(scene, context.law_folders());
  check_measurable(scene, problem);
  const Mesh& mesh = problem.mesh.mesh;
  context.tell(fmt::format("mesh: {} elements, {} nodes", mesh.num_elements(), mesh.num_nodes()));
  summary.warnings = mesh_warnings(problem.mesh);
  for (std::string& warning : material_warnings(problem)) {
    summary.warnings.push_back(std::move(warning));
  }
  for (const std::string& warning : summary.warnings) warn(warning);
  check_can_be_written(summary.folder);
  summary.times.mesh = watch.lap();

  const SceneKernels kernels =
      load_kernels(problem, operations_of(scene, problem, tangent_product_of(scene, problem)),
                   scene.solver.precision, context);
  for (const LoadedKernels& loaded : kernels.loaded) {
    const KernelBuildReport& report = loaded.report();
    summary.kernels.push_back({report.association, loaded.scalar(), report.up_to_date,
                               report.generate_seconds, report.compile_seconds});
  }
  summary.times.kernels = watch.lap();

  // A run that is resumed takes its own number of threads, for equal results.
  const int usual_threads = start ? start->threads : scene.solver.threads;
  const std::vector<ModelPart> parts = make_parts(problem, kernels.of_block);
  Model model = with_location(scene.file.string(), "mesh", [&] {
    return make_model(scene, problem, parts, context.threads > 0 ? context.threads : usual_threads);
  });
  summary.groups = model.groups();
  summary.tangent = model.tangent_product();
  summary.operations = operations_of(scene, problem, summary.tangent);
  summary.threads = model.num_threads();
  if (scene.dynamics) summary.plan = plan_motion(scene, problem, model);
  model.let_sleep(true);
  const std::int64_t num_steps = summary.plan ? summary.plan->num_steps : scene.solver.load_steps;
  const double time_step = summary.plan ? summary.plan->options.step : 0;
  FieldEvaluator fields(scene, problem, model, parts);
  Recorder recorder(scene, problem, model, fields, summary.folder,
                    intervals_of(scene.output, num_steps),
                    run_fingerprint(scene, problem, kernels.of_block,
                                    make_load(scene, problem, model), time_step));
  remove_left_temporaries(summary.folder);
  remove_left_temporaries(summary.folder / "series");
  if (start) {
    check_fingerprint(recorder.fingerprint(), *start, summary.folder);
    summary.resumed_from = start->position(time_step);
    context.tell(fmt::format("resuming from step {}", summary.resumed_from->step));
    for (const std::string& warning : resume_warnings(scene, problem, *start, summary.threads)) {
      summary.warnings.push_back(warning);
      warn(warning);
    }
    recorder.resume(*start);
  } else {
    create_folder(summary.folder);
    recorder.start();
  }
  summary.times.setup = watch.lap();
  const bool has_systems = !summary.plan || !summary.plan->critical_step;
  if (has_systems && !scene.solver.method) {
    context.tell(
        fmt::format("solver: {}, {}", solver_name(problem.solver.kind), problem.solver.reason));
  }
  context.tell(fmt::format("setup: grouped constants of {} elements in {:.2f} s, {} threads",
                           model.num_elements(), summary.times.setup, summary.threads));

  BodyState end =
      make_steps(scene, problem, model, recorder, start ? &*start : nullptr, context, summary);
  summary.times.solve = watch.lap();
  const SceneResults results = collect_results(scene, problem, model, fields, std::move(end));
  summary.skipped = model.skipped();
  summary.reordered = model.is_reordered();

  summary.scene = &scene;
  summary.problem = &problem;
  summary.results = &results;
  const std::size_t warned = summary.warnings.size();
  for (std::string& warning : solver_warnings(summary)) {
    summary.warnings.push_back(std::move(warning));
  }
  if (needs_stress(scene)) {
    for (std::string& warning :
         deformation_warnings(problem, fields.points_at(results.state.displacement))) {
      summary.warnings.push_back(std::move(warning));
    }
  }
  write_results(summary, recorder, fields);
  for (std::size_t i = warned; i < summary.warnings.size(); ++i) warn(summary.warnings[i]);
  summary.times.output = watch.lap();
  const std::string json = summary_json(summary).dump(2) + "\n";
  write_text_file(summary.folder / "summary.json", json);

  fmt::print("{}", options.json ? json : summary_text(summary));
  return report_end(summary);
}

}  // namespace

void add_run_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand(
      "run", "Simulate a scene (docs/scene.md): makes its kernels, solves, writes results");
  command->footer(
      "Writes VTU files, curves, pictures and summary.json, as the scene asks. A scene with\n"
      "[dynamics] moves in time, any other is brought to static equilibrium, in load steps if it\n"
      "says so; both keep a checkpoint after each step, from which --resume goes on to the same\n"
      "result: bit for bit, in motions solved by cholesky_cg or incomplete_cg to their tolerance.\n"
      "Exit status: 0 converged, at rest, or at the end of time; 1 not converged, or the work\n"
      "failed; 2 the scene or the call is wrong, nothing is written; 130 ended by Ctrl-C. What "
      "was\n"
      "reached is always written.\n"
      "Examples:\n"
      "  elastogen run scenes/mixed_beam.toml --out out/mixed_beam\n"
      "  elastogen run scenes/mixed_beam_falling.toml --resume\n"
      "  elastogen run scenes/beam_hexa8.toml --cells 48x8x8 --threads 2 --json");
  command->add_option("SCENE", options->scene, "Scene file, TOML")->required();
  command->add_option("--out", options->out, "Folder for results; default out/NAME_OF_THE_SCENE")
      ->type_name("DIR");
  command
      ->add_option("--cells", options->cells,
                   "Divide the scene's bar differently: NXxNYxNZ, as in 48x8x8; NXxNY in the plane")
      ->type_name("CELLS");
  command->add_flag("--resume", options->resume,
                    "Go on from the last checkpoint in the folder for results");
  command->add_flag("--json", options->json, "Print the summary as JSON");
  command->callback([options, &context] {
    context.action = [options, &context] { return run(*options, context); };
  });
}

}  // namespace elastogen::selector
