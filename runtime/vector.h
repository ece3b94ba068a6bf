// Vectors over the degrees of freedom, and the few operations that the solvers need on them.
#pragma once

#include <Eigen/Core>

namespace elastogen {

/// Values of all degrees of freedom, node-major: value[dim * node + component].
using Vector = Eigen::VectorXd;
/// A vector to read; binds without a copy to any contiguous Eigen vector or Eigen::Map.
using ConstVectorRef = Eigen::Ref<const Vector>;
/// A vector to write, likewise.
using VectorRef = Eigen::Ref<Vector>;

/// Below this length of a vector starting threads costs more than the work on it.
inline constexpr Eigen::Index parallel_length = 32768;

/// x . y, summed in fixed pieces: the result does not depend on `threads`.
[[nodiscard]] double dot(const ConstVectorRef& x, const ConstVectorRef& y, int threads);

/// Euclidean norm by `dot`.
[[nodiscard]] double norm(const ConstVectorRef& x, int threads);

/// y += a x
void axpy(double a, const ConstVectorRef& x, VectorRef y, int threads);

/// y = x + b y
void xpby(const ConstVectorRef& x, double b, VectorRef y, int threads);

}  // namespace elastogen
