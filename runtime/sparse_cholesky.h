// Sparse L L^T of the assembled stiffness on the free degrees of freedom.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/cholesky_factor.h"
#include "runtime/linear_solver.h"

namespace elastogen {

class SparseCholesky final : public LinearSolver {
 public:
  SparseCholesky(Model& model, const Constraints& constraints,
                 std::unique_ptr<CholeskyFactor> factor);

  void update() override;
  void forget() override { mode_.resize(0); }
  [[nodiscard]] bool set_shift(double shift) override;
  LinearSolveReport solve(const ConstVectorRef& b, double tolerance, VectorRef x) override;
  /// x = (L L^T)^-1 b of the last factor, and no more: for a preconditioner.
  void substitute(const ConstVectorRef& b, VectorRef x);
  /// x = about A^-1 b (CholeskyFactor::solve_roughly).
  void solve_roughly(const ConstVectorRef& b, VectorRef x);
  /// Of K + A + s D, which a factorisation found not to be positive definite; none if the factor
  /// cannot tell.
  [[nodiscard]] std::optional<int> negative_pivots() {
    return factor_->negative_pivots(free_matrix_);
  }
  [[nodiscard]] const Vector& diagonal() const override { return diagonal_; }
  [[nodiscard]] int factorizations() const override { return factorizations_; }
  [[nodiscard]] LinearSolverKind kind() const override { return LinearSolverKind::cholesky; }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void number_free();
  void find_pattern();
  void take_free(const ConstVectorRef& b);
  void give_free(VectorRef x) const;
  [[nodiscard]] double lowest_curvature();

  Model& model_;
  const Constraints& constraints_;
  std::vector<std::int32_t> free_numbers_;     // [dof] row in free_matrix_, -1 where constrained
  Matrix stiffness_;                           // all degrees of freedom, full storage
  Matrix free_matrix_;                         // free ones, lower triangle
  std::vector<std::int32_t> sources_;          // value of stiffness_ for each one of free_matrix_
  std::vector<std::int32_t> diagonal_values_;  // [free]: its diagonal in free_matrix_
  Vector diagonal_;
  double shift_ = 0;
  Vector free_b_, free_x_;
  Vector mode_;  // [free] about the lowest mode of (K + A) x = lambda D x, or empty
  std::unique_ptr<CholeskyFactor> factor_;
  int factorizations_ = 0;
};

}  // namespace elastogen
