#include "selector/scene/motion_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "runtime/error.h"
#include "runtime/stable_step.h"
#include "selector/scene/best_cholesky.h"
#include "selector/scene/located_error.h"
#include "selector/scene/simulation.h"
#include "selector/scene/start.h"

namespace elastogen::selector {
namespace {

using Clock = std::chrono::steady_clock;

BodyState state_of(Integrator& integrator) {
  const MotionState& state = integrator.state();
  return {state.u, state.v, integrator.internal_forces(), integrator.reactions(),
          integrator.kinetic_energy()};
}

/// Says now and then how far a motion is.
class Progress {
 public:
  Progress(const MotionPlan& plan, const Integrator& integrator, const RunHooks& hooks)
      : plan_(plan), integrator_(integrator), hooks_(hooks), first_(integrator.state().step) {}

  void step_made() {
    const Clock::time_point now = Clock::now();
    if (now - told_at_ < std::chrono::seconds(1)) return;
    told_at_ = now;
    const std::int64_t step = integrator_.state().step;
    const double rate =
        static_cast<double>(step - first_) / std::chrono::duration<double>(now - begin_).count();
    std::string line =
        fmt::format("step {} of {}  t = {:.4g} s  kinetic energy {:.3e} J", step, plan_.num_steps,
                    integrator_.time(), integrator_.kinetic_energy());
    if (integrator_.linear_iterations() > 0) {
      line +=
          fmt::format("  cg {:.1f} per step", static_cast<double>(integrator_.linear_iterations()) /
                                                  static_cast<double>(step - first_));
    }
    hooks_.tell(line + fmt::format("  ({:.3g} steps/s, at most {:.0f} s left)", rate,
                                   static_cast<double>(plan_.num_steps - step) / rate));
  }

 private:
  const MotionPlan& plan_;
  const Integrator& integrator_;
  const RunHooks& hooks_;
  const std::int64_t first_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point told_at_ = begin_;
};

/// Counts for how many steps on end the body has been at rest.
class RestWatch {
 public:
  RestWatch(const std::optional<RestCriterion>& criterion, std::size_t num_nodes, double step,
            std::int64_t quiet_steps)
      : criterion_(criterion),
        num_nodes_(static_cast<double>(num_nodes)),
        step_(step),
        quiet_steps_(quiet_steps) {}

  void step_made(const Integrator& integrator) {
    if (!criterion_) return;
    const bool quiet = integrator.kinetic_energy() < criterion_->energy_per_node * num_nodes_;
    quiet_steps_ = quiet ? quiet_steps_ + 1 : 0;
  }
  [[nodiscard]] bool at_rest(double time) const {
    return criterion_ && time >= criterion_->after &&
           static_cast<double>(quiet_steps_) * step_ >= criterion_->period;
  }
  [[nodiscard]] std::int64_t quiet_steps() const { return quiet_steps_; }

 private:
  const std::optional<RestCriterion>& criterion_;
  double num_nodes_;
  double step_;
  std::int64_t quiet_steps_;
};

}  // namespace

MotionPlan plan_motion(const Scene& scene, const Problem& problem, Model& model) {
  const DynamicsDescription& dynamics = *scene.dynamics;
  MotionPlan plan{dynamics.options, 0, {}};
  plan.options.linear_solver.kind = problem.solver.kind;
  plan.options.linear_solver.fall_back_after = problem.solver.fall_back_after;
  plan.options.linear_solver.cholesky = make_best_cholesky;
  if (scene.solver.projection) plan.options.projection = *scene.solver.projection;
  plan.options.step = dynamics.step.value_or(0);
  if (is_explicit(plan.options.scheme)) {
    const Vector rest = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
    plan.critical_step = with_location(dynamics.step_where, "dynamics", [&] {
      return critical_step(model, problem.constraints, rest);
    });
    const double longest = safe_fraction * *plan.critical_step;
    if (!dynamics.step) {
      plan.options.step = std::min(longest, dynamics.end);
    } else if (*dynamics.step > *plan.critical_step) {
      throw InputError(fmt::format(
          "{}: dynamics.step = {}: {} is unstable beyond 2 / omega = {:.4g} s, omega being the "
          "greatest frequency of this mesh: take {:.3g} or leave the key out",
          dynamics.step_where, *dynamics.step, scheme_name(plan.options.scheme),
          *plan.critical_step, longest));
    }
  }
  // The last step may be whole even where end / step is not: rounded down, but for rounding errors.
  plan.num_steps = static_cast<std::int64_t>(std::ceil(dynamics.end / plan.options.step - 1e-6));
  return plan;
}

RecordIntervals intervals_of(const OutputSettings& output, std::int64_t num_steps) {
  const auto at_most = [num_steps](std::int64_t records) {
    return std::max<std::int64_t>(1, (num_steps + records - 1) / records);
  };
  return {output.series ? output.every.value_or(at_most(usual_files)) : 0,
          output.history ? at_most(usual_rows) : 0};
}

MotionResult run_motion(const Scene& scene, const Problem& problem, Model& model,
                        const MotionPlan& plan, Recorder& recorder, const Checkpoint* start,
                        const RunHooks& hooks, BodyState& end) {
  const Clock::time_point begin = Clock::now();
  const auto dim = static_cast<std::size_t>(model.dim());
  const auto first_state = [&] {
    MotionState state = start_of_motion(model, std::span(scene.dynamics->velocity).first(dim));
    state.v += spin_velocity(problem.mesh.mesh, model.lumped_mass(), scene.dynamics->spin);
    return state;
  };
  const auto integrator =
      make_integrator(model, problem.constraints, problem.motion, make_load(scene, problem, model),
                      plan.options, start ? *start->motion : first_state());
  RestWatch rest(scene.dynamics->rest, model.num_nodes(), plan.options.step,
                 start ? start->quiet_steps : 0);
  Progress progress(plan, *integrator, hooks);
  const std::int64_t first = integrator->state().step;
  const auto keep = [&](bool must) {
    Checkpoint state;
    state.motion = integrator->state();
    state.quiet_steps = rest.quiet_steps();
    recorder.keep(std::move(state), must);
  };
  if (!start) {
    recorder.record(0, 0, state_of(*integrator));
    keep(true);
  }

  MotionResult result;
  while (true) {
    const std::int64_t step = integrator->state().step;
    if (rest.at_rest(integrator->time())) {
      result.status = MotionStatus::at_rest;
      break;
    }
    if (step >= plan.num_steps) break;
    if (hooks.interrupted()) {
      result.status = MotionStatus::interrupted;
      break;
    }
    try {
      integrator->step();
    } catch (const WorkError& error) {
      result.status = MotionStatus::failed;
      result.reason = error.what();
      break;
    }
    rest.step_made(*integrator);
    if (recorder.wants(step + 1)) {
      recorder.record(step + 1, integrator->time(), state_of(*integrator));
    }
    keep(false);
    progress.step_made();
  }
  keep(true);
  end = state_of(*integrator);
  result.steps = integrator->state().step;
  result.time = integrator->time();
  result.method = integrator->method();
  result.linear_iterations = integrator->linear_iterations();
  result.force_evaluations = integrator->force_evaluations();
  result.halvings = integrator->halvings();
  result.steps_made = result.steps - first;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

}  // namespace elastogen::selector
