// Linear solvers for the tangent, (K + A + s D) x = b on the free degrees of freedom.
//
// K may be what stands for the tangent (TangentForm). A is a diagonal that the caller adds (0
// unless set_added_diagonal is called: the mass of a time step). K is the model's stiffness about
// its linearisation point; s >= 0 is the shift that makes an indefinite K positive definite,
// relative to D = shift_scale(diagonal of K). Constrained degrees of freedom of x are 0.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/cholesky_factor.h"
#include "runtime/constraints.h"
#include "runtime/model.h"
#include "runtime/vector.h"

namespace elastogen {

enum class LinearSolverKind {
  conjugate_gradient,  ///< on the model's product, preconditioned by the nodes' blocks of K
  cholesky,            ///< of the assembled K
  /// Conjugate gradient preconditioned by the Cholesky factor of an earlier tangent, which is
  /// renewed when iterations rise: what is solved depends on the solves before it, to `tolerance`.
  cholesky_cg,
  /// The same with an incomplete factor, which is cheaper to make and to apply and worth less.
  incomplete_cg,
};

/// "cg", "cholesky", "cholesky_cg", "incomplete_cg"
[[nodiscard]] std::string_view solver_name(LinearSolverKind kind);

/// Whether solves depend on factors of earlier ones.
[[nodiscard]] inline bool keeps_factors(LinearSolverKind kind) {
  return kind == LinearSolverKind::cholesky_cg || kind == LinearSolverKind::incomplete_cg;
}

struct LinearSolverOptions {
  LinearSolverKind kind = LinearSolverKind::conjugate_gradient;
  int max_iterations = 0;  ///< of one conjugate gradient solve; 0: ten per free degree of freedom
  /// Iterations of one solve after which `conjugate_gradient` and `incomplete_cg` give way to
  /// `cholesky_cg` for good; 0: never.
  int fall_back_after = 0;
  MakeCholeskyFactor cholesky = std::make_unique<SimplicialCholesky>;
};

/// What a solver goes on with that has given way; if it has not, the options as they are.
[[nodiscard]] LinearSolverOptions going_on(LinearSolverOptions options, bool fell_back);

/// Whether the tangent's element matrices are projected to positive semi-definite ones
/// (TangentForm::semidefinite), which needs the kernels' stiffness.
enum class TangentProjection {
  never,
  on_demand,  ///< where the exact tangent is found to have negative curvature
  always,
};

/// "never", "on_demand", "always"
[[nodiscard]] std::string_view projection_name(TangentProjection projection);

/// Outcome of one solve.
struct LinearSolveReport {
  bool positive_definite = true;  ///< false: negative curvature met, x is not a solution
  bool converged = false;         ///< residual below the tolerance asked for
  int iterations = 0;             ///< of conjugate gradient; 0 for Cholesky
  double relative_residual = 0;   ///< |b - A x| / |b|; conjugate gradient's own recurrence
  /// An estimate from above of the lowest eigenvalue of (K + A) x = lambda D x: the least
  /// x.(K + A) x / x.D x among the directions looked at. Only where there was a shift, or where
  /// curvature was found not to be positive.
  std::optional<double> lowest_curvature;
};

/// Seconds spent since construction.
struct LinearSolverTimes {
  double assembly = 0;       ///< stiffness, or its diagonal blocks
  double factorization = 0;  ///< Cholesky, or inverting the blocks
  double product = 0;        ///< products of conjugate gradient
  double solve = 0;          ///< substitution; vector work of conjugate gradient
};

/// One method, bound to a model and constraints that must outlive it.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Sets A [N/m], for all degrees of freedom and from the next update on.
  void set_added_diagonal(const ConstVectorRef& added) { added_diagonal_ = added; }

  /// Takes up the model's linearisation point.
  virtual void update() = 0;

  /// Forgets what it has of earlier points: what follows depends on later ones only.
  virtual void forget() {}

  /// Sets the shift s for the solves that follow.
  /// @return false if K + A + s D is seen not to be positive definite (a factorisation failed);
  ///         conjugate gradient may see it only while solving, that on the nodes' blocks always
  [[nodiscard]] virtual bool set_shift(double shift) = 0;

  /// Solves for x to |b - A x| <= tolerance * |b| (Cholesky: exactly). b is read on the free
  /// degrees of freedom only.
  /// @param x  in: a guess; where it is no better than 0, iterations start from 0. out: 0 on
  ///           constrained degrees of freedom
  virtual LinearSolveReport solve(const ConstVectorRef& b, double tolerance, VectorRef x) = 0;

  /// Diagonal of K + A [N/m] at the last update, of an earlier factor where it last
  /// factorised.
  [[nodiscard]] virtual const Vector& diagonal() const = 0;

  /// Sparse factorisations so far.
  [[nodiscard]] virtual int factorizations() const { return 0; }

  /// What it solves by now: another than it was made for after a fall-back.
  [[nodiscard]] virtual LinearSolverKind kind() const = 0;

  [[nodiscard]] const LinearSolverTimes& times() const { return times_; }

 protected:
  Vector added_diagonal_;  // A, or empty
  LinearSolverTimes times_;
};

/// D of the shift from the diagonal of K + A: its absolute values, at least 1e-6 of their mean.
[[nodiscard]] Vector shift_scale(const Vector& diagonal);

/// @throws InternalError  the model's kernels lack an operation that the method needs
[[nodiscard]] std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options,
                                                               Model& model,
                                                               const Constraints& constraints);

}  // namespace elastogen
