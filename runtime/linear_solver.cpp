#include "runtime/linear_solver.h"

#include <array>
#include <utility>

#include "runtime/conjugate_gradient.h"
#include "runtime/earlier_cholesky.h"
#include "runtime/fall_back_solver.h"
#include "runtime/node_blocks.h"
#include "runtime/sparse_cholesky.h"

namespace elastogen {

std::string_view projection_name(TangentProjection projection) {
  constexpr std::array<std::string_view, 3> names = {"never", "on_demand", "always"};
  return names[static_cast<std::size_t>(projection)];
}

std::string_view solver_name(LinearSolverKind kind) {
  constexpr std::array<std::string_view, 4> names = {"cg", "cholesky", "cholesky_cg",
                                                     "incomplete_cg"};
  return names[static_cast<std::size_t>(kind)];
}

LinearSolverOptions going_on(LinearSolverOptions options, bool fell_back) {
  if (!fell_back) return options;
  options.kind = LinearSolverKind::cholesky_cg;
  options.fall_back_after = 0;
  return options;
}

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, Model& model,
                                                 const Constraints& constraints) {
  if (options.kind == LinearSolverKind::cholesky) {
    return std::make_unique<SparseCholesky>(model, constraints, options.cholesky());
  }
  if (options.fall_back_after > 0 && options.kind != LinearSolverKind::cholesky_cg) {
    return std::make_unique<FallBackSolver>(options, model, constraints);
  }
  std::unique_ptr<Preconditioner> preconditioner;
  switch (options.kind) {
    case LinearSolverKind::cholesky_cg:
      preconditioner = std::make_unique<EarlierCholesky>(model, constraints, options.cholesky());
      break;
    case LinearSolverKind::incomplete_cg:
      preconditioner = std::make_unique<EarlierCholesky>(model, constraints,
                                                         std::make_unique<IncompleteCholesky>());
      break;
    default:
      preconditioner = std::make_unique<NodeBlocks>(model, constraints);
  }
  return std::make_unique<ConjugateGradient>(options.kind, model, constraints,
                                             std::move(preconditioner), options.max_iterations);
}

Vector shift_scale(const Vector& diagonal) {
  if (diagonal.size() == 0) return diagonal;
  const double floor = 1e-6 * diagonal.cwiseAbs().mean();
  return diagonal.cwiseAbs().cwiseMax(floor);
}

}  // namespace elastogen
