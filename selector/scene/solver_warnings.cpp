#include "selector/scene/solver_warnings.h"

#include <fmt/format.h>

namespace elastogen::selector {

std::vector<std::string> solver_warnings(const RunSummary& summary) {
  std::vector<std::string> warnings;
  const LinearSolverKind chosen = summary.problem->solver.kind;
  const LinearSolverKind method = summary.newton ? summary.newton->method : summary.motion->method;
  const bool iterates = summary.newton || !summary.plan->critical_step;
  if (iterates && method != chosen) {
    warnings.push_back(fmt::format(
        "{} had not solved a system after {} iterations: the run went on by {}; solver.method = "
        "\"{}\" takes that from the start",
        solver_name(chosen), summary.problem->solver.fall_back_after, solver_name(method),
        solver_name(method)));
  }
  if (!summary.newton) return warnings;
  const NewtonResult& newton = *summary.newton;
  if (newton.status == NewtonStatus::converged_to_rounding) {
    warnings.push_back(fmt::format(
        "converged to rounding only: the relative residual fell to {:.1e} and no further, not to "
        "solver.tolerance = {:g}; in slender or stiff bodies numbers resolve no more",
        newton.relative_residual, summary.scene->solver.tolerance));
  }
  if (newton.stability == Stability::unstable) {
    const std::string count =
        newton.negative_eigenvalues
            ? fmt::format("its tangent has {} negative eigenvalue{}", *newton.negative_eigenvalues,
                          *newton.negative_eigenvalues == 1 ? "" : "s")
            : "its tangent has negative eigenvalues";
    warnings.push_back(fmt::format(
        "the equilibrium is unstable: {}, so the least disturbance makes the body leave it. If it "
        "stands for a real body, add a small load across it, of a thousandth say, for it to choose "
        "the branch that it takes",
        count));
  }
  return warnings;
}

}  // namespace elastogen::selector
