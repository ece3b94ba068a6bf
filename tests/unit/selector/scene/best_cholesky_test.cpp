// The command line's factorisation of large bodies, and its rounded substitution.
#include "selector/scene/best_cholesky.h"

#include <gtest/gtest.h>

namespace elastogen::selector {
namespace {

/// 7-point Laplacian of a cube of n^3 points plus the identity: lower triangle.
CholeskyFactor::Matrix laplacian(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto number = [n](int i, int j, int k) { return (i * n + j) * n + k; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const int row = number(i, j, k);
        entries.emplace_back(row, row, 7);
        if (i > 0) entries.emplace_back(row, number(i - 1, j, k), -1);
        if (j > 0) entries.emplace_back(row, number(i, j - 1, k), -1);
        if (k > 0) entries.emplace_back(row, number(i, j, k - 1), -1);
      }
    }
  }
  CholeskyFactor::Matrix matrix(n * n * n, n * n * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double residual(const CholeskyFactor::Matrix& lower, const Vector& x, const Vector& b) {
  return (lower.selfadjointView<Eigen::Lower>() * x - b).norm() / b.norm();
}

// The first size is factorised column by column, the second by dense blocks.
TEST(BestCholesky, SolvesAndSolvesRoughly) {
  for (const int n : {4, 18}) {
    const CholeskyFactor::Matrix matrix = laplacian(n);
    const auto factor = make_best_cholesky();
    factor->analyze(matrix);
    ASSERT_TRUE(factor->factorize(matrix));
    const Vector b = Vector::LinSpaced(matrix.rows(), -1, 2);
    Vector x, rough;
    factor->solve(b, x);
    EXPECT_LT(residual(matrix, x, b), 1e-14) << n;
    factor->solve_roughly(b, rough);
    EXPECT_LT(residual(matrix, rough, b), 1e-6) << n;
    if (n == 18) {
      EXPECT_NE(rough, x) << "was not rounded";
    }

    // The next factor is another one.
    const CholeskyFactor::Matrix twice = 2 * matrix;
    ASSERT_TRUE(factor->factorize(twice));
    factor->solve_roughly(b, rough);
    EXPECT_LT((2 * rough - x).norm(), 1e-6 * x.norm()) << n;
  }
}

}  // namespace
}  // namespace elastogen::selector
