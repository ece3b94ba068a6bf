#include "runtime/cholesky_factor.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

namespace elastogen {

struct SimplicialCholesky::Factor
    : Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> {
  [[nodiscard]] double multiplications() const {
    return m_nonZerosPerCol.cast<double>().squaredNorm();
  }
};

SimplicialCholesky::SimplicialCholesky() : factor_(std::make_unique<Factor>()) {}
SimplicialCholesky::~SimplicialCholesky() = default;

void SimplicialCholesky::analyze(const Matrix& matrix) { factor_->analyzePattern(matrix); }

bool SimplicialCholesky::factorize(const Matrix& matrix) {
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

void SimplicialCholesky::solve(const Vector& b, Vector& x) { x = factor_->solve(b); }

std::optional<int> SimplicialCholesky::negative_pivots(const Matrix& matrix) {
  const Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(matrix);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return static_cast<int>((factor.vectorD().array() < 0).count());
}

double SimplicialCholesky::multiplications() const { return factor_->multiplications(); }

struct IncompleteCholesky::Factor
    : Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>> {};

IncompleteCholesky::IncompleteCholesky() : factor_(std::make_unique<Factor>()) {}
IncompleteCholesky::~IncompleteCholesky() = default;

void IncompleteCholesky::analyze(const Matrix& matrix) { factor_->analyzePattern(matrix); }

bool IncompleteCholesky::factorize(const Matrix& matrix) {
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

void IncompleteCholesky::solve(const Vector& b, Vector& x) { x = factor_->solve(b); }

}  // namespace elastogen
