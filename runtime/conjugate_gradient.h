// Conjugate gradient on the model's product, preconditioned by the nodes' blocks of K + s D.
#pragma once

#include <vector>

#include "runtime/linear_solver.h"

namespace elastogen {

class ConjugateGradient final : public LinearSolver {
 public:
  ConjugateGradient(Model& model, const Constraints& constraints, int max_iterations);

  void update() override;
  [[nodiscard]] bool set_shift(double shift) override;
  LinearSolveReport solve(const ConstVectorRef& b, double tolerance, VectorRef x) override;
  [[nodiscard]] const Vector& diagonal() const override { return diagonal_; }

 private:
  template <int Dim>
  void invert_blocks();
  template <int Dim>
  double precondition();

  void multiply();

  Model& model_;
  const Constraints& constraints_;
  int max_iterations_;
  double shift_ = 0;
  std::vector<double> blocks_;    // [node][i][j] of K
  std::vector<double> inverses_;  // [node][i][j] of (K + s D)^-1 on the free components
  Vector diagonal_, scale_;       // of K; D
  Vector residual_, preconditioned_, direction_, product_;
};

}  // namespace elastogen
