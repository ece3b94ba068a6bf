// Sparse Cholesky factorisations, exchangeable.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <optional>

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
  /// x = (L L^T)^-1 b, after a factorisation that succeeded.
  virtual void solve(const Vector& b, Vector& x) = 0;
  /// The same with L rounded to single precision, where that is faster: for preconditioning.
  virtual void solve_roughly(const Vector& b, Vector& x) { solve(b, x); }

  /// Negative pivots of L D L^T = A, as many as A has negative eigenvalues (Sylvester's law of
  /// inertia); none where it cannot be told, as by factorisations that end at such a pivot.
  /// @param matrix  of the pattern analysed
  [[nodiscard]] virtual std::optional<int> negative_pivots(const Matrix&) { return std::nullopt; }

  /// Whether L has entries where A has none: rows are then ordered so that these are few, else as
  /// the nodes are numbered.
  [[nodiscard]] virtual bool has_fill() const { return true; }
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
  [[nodiscard]] std::optional<int> negative_pivots(const Matrix& matrix) override;

  /// Of one factorisation, after `analyze`: squares of the columns' lengths, summed.
  [[nodiscard]] double multiplications() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// L with as many entries in each column as A's lower triangle has, the largest ones; an incomplete
/// factorisation for preconditioning, with a diagonal shift where it would break down.
/// Source: Lin & More, Incomplete Cholesky factorizations with limited memory, SIAM J. Sci. Comput.
/// 21 (1999) 24-45; Eigen's.
class IncompleteCholesky final : public CholeskyFactor {
 public:
  IncompleteCholesky();
  ~IncompleteCholesky() override;

  void analyze(const Matrix& matrix) override;
  [[nodiscard]] bool factorize(const Matrix& matrix) override;
  void solve(const Vector& b, Vector& x) override;
  [[nodiscard]] bool has_fill() const override { return false; }

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace elastogen
