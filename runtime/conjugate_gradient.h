// Conjugate gradient on the model's product, preconditioned.
#pragma once

#include <memory>

#include "runtime/linear_solver.h"
#include "runtime/preconditioner.h"

namespace elastogen {

class ConjugateGradient final : public LinearSolver {
 public:
  /// @param kind  what `preconditioner` makes of it
  ConjugateGradient(LinearSolverKind kind, Model& model, const Constraints& constraints,
                    std::unique_ptr<Preconditioner> preconditioner, int max_iterations);

  void update() override;
  [[nodiscard]] bool set_shift(double shift) override;
  LinearSolveReport solve(const ConstVectorRef& b, double tolerance, VectorRef x) override;
  void forget() override { preconditioner_->forget(); }
  [[nodiscard]] const Vector& diagonal() const override { return preconditioner_->diagonal(); }
  [[nodiscard]] int factorizations() const override { return preconditioner_->factorizations(); }
  [[nodiscard]] LinearSolverKind kind() const override { return kind_; }

 private:
  void multiply();
  void note_curvature(double curvature, LinearSolveReport& report) const;
  double start(const ConstVectorRef& b, double b_norm, VectorRef x);

  LinearSolverKind kind_;
  Model& model_;
  const Constraints& constraints_;
  int max_iterations_;
  std::unique_ptr<Preconditioner> preconditioner_;
  double shift_ = 0;
  Vector scale_;  // D, where there is a shift
  Vector residual_, preconditioned_, direction_, product_;
};

}  // namespace elastogen
