#include "runtime/fall_back_solver.h"

namespace elastogen {
namespace {

LinearSolverOptions limited(LinearSolverOptions options) {
  options.max_iterations = options.fall_back_after;
  options.fall_back_after = 0;
  return options;
}

LinearSolverTimes sum(const LinearSolverTimes& a, const LinearSolverTimes& b) {
  return {a.assembly + b.assembly, a.factorization + b.factorization, a.product + b.product,
          a.solve + b.solve};
}

}  // namespace

FallBackSolver::FallBackSolver(const LinearSolverOptions& options, Model& model,
                               const Constraints& constraints)
    : model_(model),
      constraints_(constraints),
      options_(limited(options)),
      active_(make_linear_solver(options_, model, constraints)) {}

void FallBackSolver::add_times() { times_ = sum(times_before_, active_->times()); }

void FallBackSolver::update() {
  active_->set_added_diagonal(added_diagonal_);
  active_->update();
  add_times();
}

bool FallBackSolver::set_shift(double shift) {
  shift_ = shift;
  const bool is_definite = active_->set_shift(shift);
  add_times();
  return is_definite;
}

void FallBackSolver::fall_back() {
  times_before_ = active_->times();
  options_ = going_on(options_, true);
  options_.max_iterations = 0;
  active_ = make_linear_solver(options_, model_, constraints_);
  update();
}

LinearSolveReport FallBackSolver::solve(const ConstVectorRef& b, double tolerance, VectorRef x) {
  LinearSolveReport report = active_->solve(b, tolerance, x);
  if (report.positive_definite && !report.converged &&
      options_.kind != LinearSolverKind::cholesky_cg) {
    fall_back();
    const int iterations = report.iterations;
    report = {};
    report.positive_definite = active_->set_shift(shift_);
    if (report.positive_definite) report = active_->solve(b, tolerance, x);
    report.iterations += iterations;
  }
  add_times();
  return report;
}

}  // namespace elastogen
