#include "runtime/stability.h"

#include <cmath>
#include <limits>
#include <random>

#include "runtime/sparse_cholesky.h"

namespace elastogen {
namespace {

// Of a right side of all n modes each is about 1 / sqrt(n): it must be solved for, not left over.
constexpr double part_of_a_mode = 0.1;

// Pivots have errors of some ulp of the diagonal, which are no instability.
double rounding_of_pivots(const Model& model) {
  const bool single = model.precision() != Precision::double_precision;
  return 64 * (single ? static_cast<double>(std::numeric_limits<float>::epsilon())
                      : std::numeric_limits<double>::epsilon());
}

// Conjugate gradient's answer to a right side of all modes: whether it solved for them all without
// meeting negative curvature.
bool finds_all_stiff(LinearSolver& solver, const Constraints& constraints) {
  solver.update();
  if (!solver.set_shift(0)) return false;
  Vector b(static_cast<Eigen::Index>(constraints.num_dofs()));
  std::minstd_rand random;  // the same numbers everywhere, unlike those of distributions
  for (double& value : b) {
    value = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
  }
  Vector x = Vector::Zero(b.size());
  const double tolerance = part_of_a_mode / std::sqrt(static_cast<double>(constraints.num_free()));
  const LinearSolveReport probe = solver.solve(b, tolerance, x);
  return probe.positive_definite && probe.converged;
}

}  // namespace

StabilityReport check_stability(LinearSolver& solver, Model& model, const Constraints& constraints,
                                const MakeCholeskyFactor& make_factor, bool may_factorize) {
  StabilityReport report;
  if (solver.kind() == LinearSolverKind::conjugate_gradient) {
    if (!may_factorize) return report;
  } else if (finds_all_stiff(solver, constraints)) {
    report.stability = Stability::stable;
    return report;
  }
  SparseCholesky factor(model, constraints, make_factor());
  factor.update();
  report.stability = Stability::stable;
  if (!factor.set_shift(0) && !factor.set_shift(rounding_of_pivots(model))) {
    report.stability = Stability::unstable;
    report.negative_eigenvalues = factor.negative_pivots();
  }
  report.factorizations = factor.factorizations();
  return report;
}

}  // namespace elastogen
