#include "runtime/linear_solver.h"

#include <array>

#include "runtime/conjugate_gradient.h"
#include "runtime/sparse_cholesky.h"

namespace elastogen {

std::string_view projection_name(TangentProjection projection) {
  constexpr std::array<std::string_view, 3> names = {"never", "on_demand", "always"};
  return names[static_cast<std::size_t>(projection)];
}

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, Model& model,
                                                 const Constraints& constraints) {
  if (options.kind == LinearSolverKind::cholesky) {
    return std::make_unique<SparseCholesky>(model, constraints, options.cholesky());
  }
  return std::make_unique<ConjugateGradient>(model, constraints, options.max_iterations);
}

Vector shift_scale(const Vector& diagonal) {
  if (diagonal.size() == 0) return diagonal;
  const double floor = 1e-6 * diagonal.cwiseAbs().mean();
  return diagonal.cwiseAbs().cwiseMax(floor);
}

}  // namespace elastogen
