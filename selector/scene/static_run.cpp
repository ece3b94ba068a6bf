#include "selector/scene/static_run.h"

#include <fmt/format.h>

#include "selector/scene/best_cholesky.h"
#include "selector/scene/simulation.h"

namespace elastogen::selector {
namespace {

std::string progress_line(const NewtonProgress& progress) {
  std::string line = fmt::format(
      "newton {:3}  residual {:.3e} (relative {:.1e})  potential {:.8e} J", progress.iteration,
      progress.residual, progress.relative_residual, progress.potential);
  if (progress.iteration > 0) line += fmt::format("  step {:.3g}", progress.step);
  if (progress.linear_iterations > 0) line += fmt::format("  cg {}", progress.linear_iterations);
  if (progress.projected) line += "  projected";
  if (progress.shift > 0) line += fmt::format("  shift {:.1e}", progress.shift);
  if (progress.load_factor < 1) line += fmt::format("  load {:.3g}", progress.load_factor);
  return line;
}

NewtonOptions newton_options(const SolverSettings& solver, const SolverChoice& choice) {
  NewtonOptions options;
  options.linear_solver.kind = choice.kind;
  options.linear_solver.fall_back_after = choice.fall_back_after;
  options.factorize_for_stability = choice.factorize_for_stability;
  options.linear_solver.cholesky = make_best_cholesky;
  if (solver.projection) options.projection = *solver.projection;
  options.tolerance = solver.tolerance;
  options.max_iterations = solver.max_iterations;
  options.load_steps = solver.load_steps;
  return options;
}

}  // namespace

NewtonResult run_static(const Scene& scene, const Problem& problem, Model& model,
                        Recorder& recorder, const Checkpoint* start, const RunHooks& hooks,
                        BodyState& end) {
  const Vector load = make_load(scene, problem, model);
  /// Of a displacement that a fraction of the load holds.
  const auto state_at = [&](const Vector& displacement, double load_factor) {
    BodyState state{displacement, {}, Vector::Zero(load.size()), {}, 0};
    model.forces(displacement, state.internal_forces);
    state.reactions = -(load_factor * load + state.internal_forces);
    problem.constraints.project_constrained(state.reactions);
    return state;
  };
  const bool has_steps = scene.has_steps();
  const auto record = [&](const LoadState& state) {
    if (recorder.wants(state.load_steps)) {
      recorder.record(state.load_steps, state.load_factor, state_at(state.u, state.load_factor));
    }
    if (!has_steps) return;
    Checkpoint checkpoint;
    checkpoint.load = state;
    recorder.keep(std::move(checkpoint), true);
  };

  LoadState state;
  if (start) {
    state = *start->load;
  } else {
    state.u = start_displacement(problem.mesh.mesh, scene.start);
    record(state);
  }
  NewtonOptions options = newton_options(scene.solver, problem.solver);
  options.on_load_step = record;
  options.on_iteration = [&](const NewtonProgress& progress) {
    hooks.tell(progress_line(progress));
    return !hooks.interrupted();
  };
  NewtonResult result =
      solve_static(model, problem.constraints, problem.motion, load, options, state);
  end = {state.u, {}, result.internal_forces, result.reactions, 0};
  return result;
}

}  // namespace elastogen::selector
