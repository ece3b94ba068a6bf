// Static equilibrium by Newton's method on the total potential.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/constraints.h"
#include "runtime/linear_solver.h"
#include "runtime/model.h"
#include "runtime/prescribed_motion.h"
#include "runtime/vector.h"

namespace elastogen {

/// Equilibrium after a load step: all that the next load step depends on.
struct LoadState {
  Vector u;                ///< displacement [m]
  double load_factor = 0;  ///< fraction of the load and of the motion that u balances
  double increment = 0;    ///< of the next load step; 0: 1 / NewtonOptions::load_steps
  int load_steps = 0;      ///< that converged
  int iterations = 0;      ///< Newton, so far
  bool fell_back = false;  ///< LinearSolverOptions::fall_back_after has been reached
};

/// State after one Newton iteration.
struct NewtonProgress {
  int iteration = 0;             ///< counted over all load steps, from 1; 0 is the start
  double load_factor = 1;        ///< fraction of the load and motion of the present load step
  double residual = 0;           ///< |r| on the free degrees of freedom [N]
  double relative_residual = 0;  ///< residual over its reference (NewtonOptions::tolerance)
  double potential = 0;          ///< W(u) - f.u [J]
  double step = 0;               ///< length taken of the Newton step, in (0, 1]
  double shift = 0;              ///< diagonal shift s of the tangent K + s D
  bool projected = false;        ///< the tangent was projected to a semi-definite one
  int linear_iterations = 0;     ///< conjugate gradient iterations in this Newton iteration
};

struct NewtonOptions {
  LinearSolverOptions linear_solver;
  TangentProjection projection = TangentProjection::never;

  /// Converged when |r| <= tolerance * max(|f|, |R|), all 2-norms over degrees of freedom:
  /// r = f - dW/dU on the free ones, f the load on the free ones, R the reactions on the
  /// constrained ones. Where rounding keeps r above that, iterations go on until it has stopped
  /// falling (NewtonStatus::converged_to_rounding).
  double tolerance = 1e-8;
  int max_iterations = 100;  ///< of each load step
  /// Load and prescribed motion are applied in this many equal steps; a step that fails is halved.
  int load_steps = 1;
  int max_halvings = 8;  ///< of one load step before giving up
  /// Factorise the last tangent to tell whether the equilibrium is stable also where the method has
  /// no factor.
  bool factorize_for_stability = false;

  /// Called at the start and after each iteration; return false to stop. May be empty.
  std::function<bool(const NewtonProgress&)> on_iteration;
  /// Called after each load step that converged. May be empty.
  std::function<void(const LoadState&)> on_load_step;
};

enum class NewtonStatus {
  converged,
  /// The residual is above the tolerance and falls no further, being no more than what rounding
  /// makes of it: 4 eps |D u| with D the diagonal of K. As near to equilibrium as numbers allow.
  converged_to_rounding,
  not_converged,
  interrupted,
};

/// "converged", "converged to rounding", "not converged", "interrupted"
[[nodiscard]] std::string_view status_name(NewtonStatus status);

/// Whether a solve has ended at an equilibrium, as well as it could be computed.
[[nodiscard]] inline bool in_equilibrium(NewtonStatus status) {
  return status == NewtonStatus::converged || status == NewtonStatus::converged_to_rounding;
}

/// Whether the tangent at an equilibrium is positive definite.
enum class Stability {
  stable,
  unstable,     ///< it has a negative eigenvalue: the least disturbance lets the body move away
  not_checked,  ///< a factorisation would have cost much of what the solve did; or no equilibrium
};

/// "stable", "unstable", "not checked"
[[nodiscard]] std::string_view stability_name(Stability stability);

struct NewtonTimes {
  double forces = 0;         ///< energies and forces [s]
  double linearization = 0;  ///< linearisation, assembly, preconditioner, products [s]
  double solve = 0;          ///< factorisation, substitution, vector work of the solver [s]
  double total = 0;          ///< [s]
};

struct NewtonResult {
  NewtonStatus status = NewtonStatus::not_converged;
  std::string reason;  ///< one sentence when not converged, naming an element where one is bad
  int iterations = 0;  ///< counted from load factor 0, as LoadState does
  int load_steps = 0;  ///< load steps that converged, likewise
  int linear_iterations = 0;  ///< conjugate gradient, in total
  int factorizations = 0;     ///< Cholesky, in total
  int projections = 0;        ///< tangents that were projected, in total
  /// What solved the last systems: another than was asked for after a fall-back.
  LinearSolverKind method = LinearSolverKind::conjugate_gradient;
  Stability stability = Stability::not_checked;
  std::optional<int> negative_eigenvalues;  ///< where unstable and the factor tells
  int energy_evaluations = 0;
  double load_factor = 0;        ///< fraction of the load that `u` balances; 1 when converged
  double residual = 0;           ///< |r| at the end [N]
  double relative_residual = 0;  ///< over max(|f|, |R|)
  double energy = 0;             ///< W(u) [J]
  double potential = 0;          ///< W(u) - f.u [J]
  Vector internal_forces;        ///< -dW/dU at the end [N]
  Vector reactions;              ///< forces of the supports on the body, 0 where free [N]
  NewtonTimes times;
};

/// Minimises the total potential Pi(u) = W(u) - load.u under the constraints.
///
/// Each iteration solves (K + s D) d = r and moves along d by a backtracking line search that
/// decreases Pi (Armijo); an energy that is not finite, or an element out of its law's domain,
/// counts as too long a step. Where energy differences drown in rounding, a decrease of |r| is
/// asked for instead. The shift s is 0 while K is positive definite, else one and a half times the
/// lowest eigenvalue's absolute value (TangentShift); with a projection of K on demand, that is
/// tried first. Conjugate gradient is solved inexactly with a tolerance after Eisenstat and Walker,
/// "Choosing the forcing terms in an inexact Newton method", SIAM J. Sci. Comput. 17 (1996),
/// choice 2.
///
/// Prescribed motion is made at once at the start of a load step, the rest of the body following it
/// to first order; the line search begins after that.
///
/// @param load    dead load on all degrees of freedom [N]; what acts on constrained ones goes into
///                the reactions
/// @param motion  of the constrained degrees of freedom, the load factor standing for the time
/// @param state   in: start, by its load factor and increment in the midst of a solve; out: the
///                last state that was reached, in equilibrium or not. Given equal states, models
///                and numbers of threads, what follows is equal bit for bit.
/// @throws InputError  wrong options; no constraint at all; the elements are bad at the start
[[nodiscard]] NewtonResult solve_static(Model& model, const Constraints& constraints,
                                        const PrescribedMotion& motion, const ConstVectorRef& load,
                                        const NewtonOptions& options, LoadState& state);

/// The same from load factor 0, the constraints' displacements growing with the load.
/// @param u  in: start; out: equilibrium, or the last state that was reached
[[nodiscard]] NewtonResult solve_static(Model& model, const Constraints& constraints,
                                        const ConstVectorRef& load, const NewtonOptions& options,
                                        Vector& u);

}  // namespace elastogen
