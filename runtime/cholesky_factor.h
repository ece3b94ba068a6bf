// Sparse Cholesky factorisations, exchangeable.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <memory>

#include "runtime/vector.h"

namespace elastogen {

/// L L^T = A of a symmetric sparse matrix A, whose rows come in an order that makes L sparse.
class CholeskyFactor {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  virtual ~CholeskyFactor() = default;

  /// Takes up a pattern: finds that of L.
  /// @param matrix  lower triangle, compressed; its values are not read
  virtual void analyze(const Matrix& matrix) = 0;
  /// @param matrix  of the pattern analysed
  /// @return false if it is seen not to be positive definite
  [[nodiscard]] virtual bool factorize(const Matrix& matrix) = 0;
  /// x = A^-1 b, after a factorisation that succeeded.
  virtual void solve(const Vector& b, Vector& x) = 0;
};

using MakeCholeskyFactor = std::function<std::unique_ptr<CholeskyFactor>()>;

/// Eigen's, column by column.
class SimplicialCholesky final : public CholeskyFactor {
 public:
  SimplicialCholesky();
  ~SimplicialCholesky() override;

  void analyze(const Matrix& matrix) override;
  [[nodiscard]] bool factorize(const Matrix& matrix) override;
  void solve(const Vector& b, Vector& x) override;

  /// Of one factorisation, after `analyze`: squares of the columns' lengths, summed.
  [[nodiscard]] double multiplications() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace elastogen
