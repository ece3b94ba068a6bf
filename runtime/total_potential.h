// The total potential of a model under dead load, and its decrease along a direction.
#pragma once

#include "runtime/constraints.h"
#include "runtime/model.h"
#include "runtime/vector.h"

namespace elastogen {

/// A displacement with its energies and forces.
struct StaticState {
  Vector u;
  Vector forces;         ///< -dW/dU [N]
  Vector residual;       ///< load - dW/dU on the free degrees of freedom, 0 on the others [N]
  double energy = 0;     ///< W(u) [J]
  double potential = 0;  ///< W(u) - load.u [J]
  double residual_norm = 0;
};

enum class LineSearchOutcome {
  accepted,     ///< the trial state satisfies the decrease asked for
  at_rounding,  ///< no step can decrease the potential by more than its rounding error
  failed,       ///< no acceptable step down to the smallest one
};

/// Total potential W(u) - load.u of a model, evaluated in states.
class TotalPotential {
 public:
  TotalPotential(Model& model, const Constraints& constraints, const ConstVectorRef& full_load);

  /// The load is full_load * factor from now on.
  void set_load_factor(double factor);
  [[nodiscard]] const Vector& load() const { return load_; }

  /// Computes energy and potential of state.u.
  /// @return false if the energy is not finite or an element is bad
  [[nodiscard]] bool evaluate_energy(StaticState& state);

  /// Computes forces and residual of state.u; same result.
  [[nodiscard]] bool evaluate_forces(StaticState& state);

  /// What rounding may do to a potential [J].
  [[nodiscard]] double rounding(const StaticState& state) const;

  /// Looks for a step a in (0, 1] such that trial.u = start.u + a * direction decreases the
  /// potential by at least 1e-4 of what its slope promises (Armijo; Nocedal & Wright, Numerical
  /// Optimization, 2nd ed., eq. 3.4). A bad trial state counts as too long a step. Where the
  /// promised decrease of a whole step is below rounding, a smaller residual is asked for instead,
  /// unless the tangent is indefinite: leaving a saddle starts with a growing residual.
  ///
  /// @param positive_definite  whether the direction came from a tangent without shift
  /// @param trial  out: the accepted state, with forces
  /// @param step   out: a
  [[nodiscard]] LineSearchOutcome search(const StaticState& start, const Vector& direction,
                                         bool positive_definite, StaticState& trial, double& step);

  [[nodiscard]] int num_energy_evaluations() const { return num_energy_evaluations_; }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  Model& model_;
  const Constraints& constraints_;
  Vector full_load_, load_;
  int num_energy_evaluations_ = 0;
  double seconds_ = 0;
};

}  // namespace elastogen
