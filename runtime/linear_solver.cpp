#include "runtime/linear_solver.h"

#include "runtime/conjugate_gradient.h"
#include "runtime/sparse_cholesky.h"

namespace elastogen {

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, Model& model,
                                                 const Constraints& constraints) {
  if (options.kind == LinearSolverKind::cholesky) {
    return std::make_unique<SparseCholesky>(model, constraints);
  }
  return std::make_unique<ConjugateGradient>(model, constraints, options.max_iterations);
}

Vector shift_scale(const Vector& diagonal) {
  if (diagonal.size() == 0) return diagonal;
  const double floor = 1e-6 * diagonal.cwiseAbs().mean();
  return diagonal.cwiseAbs().cwiseMax(floor);
}

}  // namespace elastogen
