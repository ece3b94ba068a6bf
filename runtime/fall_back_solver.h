// A conjugate gradient that gives way to a factorisation where it gets nowhere.
#pragma once

#include <memory>

#include "runtime/linear_solver.h"

namespace elastogen {

/// Solves by LinearSolverOptions::kind until one solve has taken `fall_back_after` iterations
/// without an end, and by cholesky_cg from there on.
class FallBackSolver final : public LinearSolver {
 public:
  FallBackSolver(const LinearSolverOptions& options, Model& model, const Constraints& constraints);

  void update() override;
  void forget() override { active_->forget(); }
  [[nodiscard]] bool set_shift(double shift) override;
  LinearSolveReport solve(const ConstVectorRef& b, double tolerance, VectorRef x) override;
  [[nodiscard]] const Vector& diagonal() const override { return active_->diagonal(); }
  [[nodiscard]] int factorizations() const override { return active_->factorizations(); }
  [[nodiscard]] LinearSolverKind kind() const override { return options_.kind; }

 private:
  void fall_back();
  void add_times();

  Model& model_;
  const Constraints& constraints_;
  LinearSolverOptions options_;  // of the active solver
  std::unique_ptr<LinearSolver> active_;
  LinearSolverTimes times_before_;  // of the solver that gave way
  double shift_ = 0;
};

}  // namespace elastogen
