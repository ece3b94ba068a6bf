// Whether an equilibrium is stable, by the inertia of its tangent.
#pragma once

#include <optional>

#include "runtime/linear_solver.h"
#include "runtime/newton.h"

namespace elastogen {

struct StabilityReport {
  Stability stability = Stability::not_checked;
  std::optional<int> negative_eigenvalues;  ///< where unstable and the factor tells
  int factorizations = 0;                   ///< on top of the solver's own
};

/// Looks for negative eigenvalues of K about the model's linearisation point, which must be the
/// exact tangent at the equilibrium: all pivots of L D L^T are positive where there is none, and as
/// many are negative as there are of them (Sylvester's law of inertia).
///
/// A solver with an earlier factor is asked for the solution of a system with a right side of all
/// modes, which is cheaper: conjugate gradient meets negative curvature on its way. One without a
/// factor cannot tell.
///
/// @param may_factorize  factorise whatever the solver is
[[nodiscard]] StabilityReport check_stability(LinearSolver& solver, Model& model,
                                              const Constraints& constraints,
                                              const MakeCholeskyFactor& make_factor,
                                              bool may_factorize);

}  // namespace elastogen
