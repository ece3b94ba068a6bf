#include "runtime/newton.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/error.h"
#include "runtime/stability.h"
#include "runtime/stopwatch.h"
#include "runtime/tangent_shift.h"
#include "runtime/total_potential.h"

namespace elastogen {
namespace {

// Of linear systems. With a factor ten times the precision costs a few iterations, and slender
// bodies need a seventh fewer tangents for it.
constexpr double loosest_forcing_without_factor = 0.1;
constexpr double loosest_forcing_with_factor = 0.01;
constexpr double forcing_factor = 0.9;  // gamma of Eisenstat & Walker, choice 2
// A residual within rounding falls no further once so many iterations have not halved it.
constexpr int fruitless_iterations = 2;
// A last step by less of |u| than this leaves the tangent's inertia as it was.
constexpr double small_move = 1e-3;

void check_options(const NewtonOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw InputError(
        fmt::format("Newton: tolerance = {}; must be between 0 and 1", options.tolerance));
  }
  if (options.max_iterations < 1 || options.load_steps < 1 || options.max_halvings < 0) {
    throw InputError(
        fmt::format("Newton: max_iterations = {}, load_steps = {}, max_halvings = {}; "
                    "must be at least 1, 1 and 0",
                    options.max_iterations, options.load_steps, options.max_halvings));
  }
}

// `moved`: one Newton step was taken. `failed` may go better with a smaller load step, `stopped`
// may not.
enum class StepOutcome { moved, converged, failed, stopped, interrupted };

class StaticSolver {
 public:
  StaticSolver(Model& model, const Constraints& constraints, const PrescribedMotion& motion,
               const ConstVectorRef& load, const NewtonOptions& options, bool fell_back)
      : model_(model),
        constraints_(constraints),
        motion_(motion),
        options_(options),
        potential_(model, constraints, load),
        solver_(make_linear_solver(going_on(options.linear_solver, fell_back), model, constraints)),
        has_load_(load.squaredNorm() > 0) {}

  void run(LoadState& state);
  // Once, after run().
  [[nodiscard]] NewtonResult result();

 private:
  void evaluate_start(double factor);
  StepOutcome solve_load_step(double factor);
  void linearize(TangentForm form);
  bool make_definite();
  bool is_exact() const { return shift_.value() == 0 && form_ == TangentForm::exact; }
  bool find_direction(double forcing, bool has_gap);
  StepOutcome take_step(double factor, bool has_gap);
  bool residual_stopped_falling();
  void judge_stability();
  double loosest_forcing() const;
  double forcing_term(double threshold);
  double reference() const;
  double rounding() const;
  bool report(double factor, double step, int linear_iterations);

  Model& model_;
  const Constraints& constraints_;
  const PrescribedMotion& motion_;
  const NewtonOptions& options_;
  TotalPotential potential_;
  std::unique_ptr<LinearSolver> solver_;
  bool has_load_;
  StaticState state_, trial_;
  Vector gap_;  // motion of constrained degrees of freedom still to be made
  Vector right_side_, direction_;
  double start_residual_ = 0;
  double previous_residual_ = 0;  // of the Newton iteration before, 0 if there is none
  double previous_forcing_ = 0;
  double least_residual_ = 0;  // of the load step, where it was last halved
  int fruitless_ = 0;          // iterations since then
  TangentForm form_ = TangentForm::exact;
  TangentShift shift_;
  double step_ = 1;
  double definite_within_ = -1;  // distance to a state whose tangent was factorised, or -1
  std::string reason_;
  NewtonResult result_;
};

// What |r| is compared with: the load on the free degrees of freedom and the reactions.
double StaticSolver::reference() const {
  const int threads = model_.num_threads();
  Vector free_load = potential_.load();
  constraints_.project(free_load);
  Vector reactions = potential_.load() + state_.forces;
  constraints_.project_constrained(reactions);
  const double largest = std::max(norm(free_load, threads), norm(reactions, threads));
  // A body released from a deformed start ends without load or reaction.
  return has_load_ || !motion_.empty() ? largest : std::max(largest, start_residual_);
}

// What rounding of u does to |r|.
double StaticSolver::rounding() const {
  return 4 * model_.epsilon() * solver_->diagonal().cwiseProduct(state_.u).norm();
}

// Within rounding iterations refine the solution of the linear systems, whose errors in slender
// bodies are a million times those of the residual.
bool StaticSolver::residual_stopped_falling() {
  if (state_.residual_norm <= 0.5 * least_residual_) {
    least_residual_ = state_.residual_norm;
    fruitless_ = 0;
    return false;
  }
  ++fruitless_;
  return fruitless_ >= fruitless_iterations && state_.residual_norm <= rounding();
}

double StaticSolver::loosest_forcing() const {
  return keeps_factors(solver_->kind()) ? loosest_forcing_with_factor
                                        : loosest_forcing_without_factor;
}

// Choice 2 of Eisenstat & Walker with their safeguards; never tighter than the end asks for.
double StaticSolver::forcing_term(double threshold) {
  const double loosest = loosest_forcing();
  double forcing = loosest;
  if (previous_residual_ > 0) {
    const double ratio = state_.residual_norm / previous_residual_;
    forcing = forcing_factor * ratio * ratio;
    const double safeguard = forcing_factor * previous_forcing_ * previous_forcing_;
    if (safeguard > 0.1) forcing = std::max(forcing, safeguard);
  }
  forcing = std::min(forcing, loosest);
  if (state_.residual_norm > 0) {
    forcing = std::max(forcing, std::min(loosest, 0.5 * threshold / state_.residual_norm));
  }
  previous_forcing_ = forcing;
  previous_residual_ = state_.residual_norm;
  return forcing;
}

void StaticSolver::linearize(TangentForm form) {
  {
    const Stopwatch watch(result_.times.linearization);
    model_.linearize(state_.u, form);
  }
  form_ = form;
  if (form == TangentForm::semidefinite) ++result_.projections;
  solver_->update();
}

// Makes the tangent more definite than it is, if there is a way left.
bool StaticSolver::make_definite() {
  if (form_ == TangentForm::exact && options_.projection == TangentProjection::on_demand) {
    linearize(TangentForm::semidefinite);
    shift_.restart();  // what is known of it is of the exact tangent
    return true;
  }
  if (shift_.grow()) return true;
  reason_ = "the tangent is not positive definite even with the largest diagonal shift";
  return false;
}

// Solves (K + s D) direction = residual - K gap, with the smallest shift that is found to work.
bool StaticSolver::find_direction(double forcing, bool has_gap) {
  while (true) {
    right_side_ = state_.residual;
    if (has_gap) {
      model_.product(gap_, 1, right_side_);
      constraints_.project(right_side_);
    }
    if (solver_->set_shift(shift_.value())) {
      direction_.setZero();
      const LinearSolveReport report = solver_->solve(right_side_, forcing, direction_);
      result_.linear_iterations += report.iterations;
      shift_.note(report.lowest_curvature);
      const bool descends = has_gap || dot(state_.residual, direction_, model_.num_threads()) > 0;
      if (report.positive_definite && descends) {
        if (!shift_.refine()) return true;
        continue;
      }
    }
    if (!make_definite()) return false;
  }
}

// Moves state_ along direction_. With a gap the constrained motion is made whole: a potential at
// another position of the supports is no measure of progress.
StepOutcome StaticSolver::take_step(double factor, bool has_gap) {
  if (has_gap) {
    step_ = 1;
    trial_.u = state_.u + direction_;
    motion_.impose(factor, trial_.u);
    if (!potential_.evaluate_energy(trial_) || !potential_.evaluate_forces(trial_)) {
      reason_ = "the prescribed motion is too large for one load step: " +
                model_.describe(model_.status());
      return StepOutcome::failed;
    }
    std::swap(state_, trial_);
    return StepOutcome::moved;
  }
  while (true) {
    switch (potential_.search(state_, direction_, is_exact(), trial_, step_)) {
      case LineSearchOutcome::accepted:
        std::swap(state_, trial_);
        return StepOutcome::moved;
      case LineSearchOutcome::at_rounding:
        if (state_.residual_norm <= rounding()) return StepOutcome::converged;
        reason_ =
            fmt::format("rounding errors keep the residual at {:.3g} N; ask for a larger tolerance",
                        state_.residual_norm);
        return StepOutcome::stopped;
      case LineSearchOutcome::failed:
        if (!make_definite() || !find_direction(loosest_forcing(), false)) {
          reason_ = "the line search found no smaller potential along any direction tried";
          return StepOutcome::failed;
        }
        break;
    }
  }
}

bool StaticSolver::report(double factor, double step, int linear_iterations) {
  if (!options_.on_iteration) return true;
  NewtonProgress progress;
  progress.iteration = result_.iterations;
  progress.load_factor = factor;
  progress.residual = state_.residual_norm;
  const double scale = reference();
  progress.relative_residual = scale > 0 ? state_.residual_norm / scale : 0;
  progress.potential = state_.potential;
  progress.step = step;
  progress.shift = shift_.value();
  progress.projected = form_ == TangentForm::semidefinite;
  progress.linear_iterations = linear_iterations;
  return options_.on_iteration(progress);
}

void StaticSolver::evaluate_start(double factor) {
  potential_.set_load_factor(factor);
  if (!potential_.evaluate_energy(state_) || !potential_.evaluate_forces(state_)) {
    throw InputError("the start of the static solve: " + model_.describe(model_.status()));
  }
}

StepOutcome StaticSolver::solve_load_step(double factor) {
  gap_ = state_.u;
  motion_.impose(factor, gap_);
  gap_ -= state_.u;
  bool has_gap = gap_.squaredNorm() > 0;

  solver_->forget();  // a load step depends on its start only: LoadState
  evaluate_start(factor);
  start_residual_ = state_.residual_norm;
  previous_residual_ = 0;
  least_residual_ = std::numeric_limits<double>::infinity();
  fruitless_ = 0;
  form_ = TangentForm::exact;
  shift_.restart();
  definite_within_ = -1;
  const int first_iteration = result_.iterations;
  if (result_.iterations == 0 && !report(factor, 0, 0)) {
    reason_ = "it was interrupted";
    return StepOutcome::interrupted;
  }

  for (bool has_tangent = false;; has_tangent = true) {
    const double threshold = options_.tolerance * reference();
    if (!has_gap && state_.residual_norm <= threshold) return StepOutcome::converged;
    // Before the first tangent D is unknown, and with it what rounding does.
    if (has_tangent && residual_stopped_falling()) return StepOutcome::converged;
    if (result_.iterations - first_iteration == options_.max_iterations) {
      reason_ = fmt::format(
          "the limit of {} Newton iterations per load step was reached on the way to load factor "
          "{:.4g}",
          options_.max_iterations, factor);
      return StepOutcome::stopped;
    }
    ++result_.iterations;
    linearize(options_.projection == TangentProjection::always ? TangentForm::semidefinite
                                                               : TangentForm::exact);
    shift_.take_next_tangent();
    const int iterations_before = result_.linear_iterations;
    if (!find_direction(forcing_term(threshold), has_gap)) return StepOutcome::failed;
    const StepOutcome outcome = take_step(factor, has_gap);
    if (outcome != StepOutcome::moved) return outcome;
    has_gap = false;
    // By a factor of this very tangent; one without shift that has failed is another's.
    const bool is_factorized = solver_->kind() == LinearSolverKind::cholesky && is_exact();
    definite_within_ = is_factorized ? step_ * direction_.norm() : -1;
    if (!report(factor, step_, result_.linear_iterations - iterations_before)) {
      reason_ = "it was interrupted";
      return StepOutcome::interrupted;
    }
  }
}

void StaticSolver::run(LoadState& state) {
  const Stopwatch watch(result_.times.total);
  state_.u = state.u;
  direction_ = Vector::Zero(state.u.size());
  if (state.increment == 0) state.increment = 1.0 / options_.load_steps;
  result_.iterations = state.iterations;
  if (state.load_factor == 1) evaluate_start(1);
  int halvings = 0;
  while (state.load_factor < 1) {
    // The last load step ends at 1 whatever the rounding of the sum.
    const double next = state.load_factor + state.increment;
    const double factor = next > 1 - 1e-9 ? 1 : next;
    const StepOutcome outcome = solve_load_step(factor);
    state.iterations = result_.iterations;
    state.fell_back = solver_->kind() != options_.linear_solver.kind;
    if (outcome == StepOutcome::converged) {
      state.u = state_.u;
      state.load_factor = factor;
      ++state.load_steps;
      halvings = 0;
      if (options_.on_load_step) options_.on_load_step(state);
    } else if (outcome == StepOutcome::failed && halvings < options_.max_halvings) {
      ++halvings;
      state.increment /= 2;
      state_.u = state.u;
    } else {
      if (outcome == StepOutcome::interrupted) result_.status = NewtonStatus::interrupted;
      result_.reason = reason_;
      break;
    }
  }
  if (state.load_factor == 1) {
    const bool met = state_.residual_norm <= options_.tolerance * reference();
    result_.status = met ? NewtonStatus::converged : NewtonStatus::converged_to_rounding;
    judge_stability();
  }
  result_.load_factor = state.load_factor;
  result_.load_steps = state.load_steps;
  state.u = state_.u;
}

void StaticSolver::judge_stability() {
  if (definite_within_ >= 0 && definite_within_ <= small_move * state_.u.norm()) {
    result_.stability = Stability::stable;
    return;
  }
  {
    const Stopwatch watch(result_.times.linearization);
    model_.linearize(state_.u);
  }
  const StabilityReport report =
      check_stability(*solver_, model_, constraints_, options_.linear_solver.cholesky,
                      options_.factorize_for_stability);
  result_.stability = report.stability;
  result_.negative_eigenvalues = report.negative_eigenvalues;
  result_.factorizations += report.factorizations;
}

NewtonResult StaticSolver::result() {
  result_.energy_evaluations = potential_.num_energy_evaluations();
  result_.residual = state_.residual_norm;
  const double scale = reference();
  result_.relative_residual = scale > 0 ? state_.residual_norm / scale : 0;
  result_.energy = state_.energy;
  result_.potential = state_.potential;
  result_.internal_forces = state_.forces;
  result_.reactions = -(potential_.load() + state_.forces);
  constraints_.project_constrained(result_.reactions);
  const LinearSolverTimes& times = solver_->times();
  result_.factorizations += solver_->factorizations();
  result_.method = solver_->kind();
  result_.times.forces = potential_.seconds();
  result_.times.linearization += times.assembly + times.product;
  result_.times.solve = times.factorization + times.solve;
  return std::move(result_);
}

}  // namespace

std::string_view status_name(NewtonStatus status) {
  constexpr std::array<std::string_view, 4> names = {"converged", "converged to rounding",
                                                     "not converged", "interrupted"};
  return names[static_cast<std::size_t>(status)];
}

std::string_view stability_name(Stability stability) {
  constexpr std::array<std::string_view, 3> names = {"stable", "unstable", "not checked"};
  return names[static_cast<std::size_t>(stability)];
}

NewtonResult solve_static(Model& model, const Constraints& constraints,
                          const PrescribedMotion& motion, const ConstVectorRef& load,
                          const NewtonOptions& options, LoadState& state) {
  check_options(options);
  const auto num_dofs = static_cast<Eigen::Index>(model.num_dofs());
  if (state.u.size() != num_dofs || load.size() != num_dofs ||
      constraints.num_dofs() != model.num_dofs()) {
    throw InternalError(fmt::format(
        "static solve: displacement, load and constraints have {}, {} and {} values, the model {}",
        state.u.size(), load.size(), constraints.num_dofs(), num_dofs));
  }
  if (constraints.num_constrained() == 0) {
    throw InputError(
        "static solve: nothing is fixed, so the body can move freely; constrain some nodes");
  }
  if (!load.allFinite()) throw InputError("static solve: the load is not finite");
  StaticSolver solver(model, constraints, motion, load, options, state.fell_back);
  solver.run(state);
  return solver.result();
}

NewtonResult solve_static(Model& model, const Constraints& constraints, const ConstVectorRef& load,
                          const NewtonOptions& options, Vector& u) {
  LoadState state;
  state.u = u;
  NewtonResult result = solve_static(model, constraints, PrescribedMotion::growing(constraints),
                                     load, options, state);
  u = std::move(state.u);
  return result;
}

}  // namespace elastogen
