// Motion in time: M dv/dt = F(u) + load - alpha M v, du/dt = v, with the lumped mass M.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "runtime/constraints.h"
#include "runtime/linear_solver.h"
#include "runtime/model.h"
#include "runtime/prescribed_motion.h"
#include "runtime/vector.h"

namespace elastogen {

enum class IntegrationScheme {
  implicit_euler,       ///< order 1, stable for any step, damps; one linear system per step
  symplectic_euler,     ///< order 1, explicit
  central_differences,  ///< order 2, explicit
};

/// "implicit_euler", "symplectic_euler", "central_differences"
[[nodiscard]] std::string_view scheme_name(IntegrationScheme scheme);

/// All that the next step depends on.
struct MotionState {
  std::int64_t step =
      0;            ///< complete steps since time 0; the time is step * IntegratorOptions::step
  Vector u;         ///< displacement [m]
  Vector v;         ///< velocity [m/s]
  Vector a;         ///< acceleration of the last step [m/s^2]
  Vector a_before;  ///< of the step before that; explicit schemes leave it 0
  bool fell_back = false;  ///< LinearSolverOptions::fall_back_after has been reached
};

struct IntegratorOptions {
  IntegrationScheme scheme = IntegrationScheme::implicit_euler;
  double step = 0;     ///< time step h [s], > 0
  double damping = 0;  ///< alpha [1/s], >= 0: the damping force is -alpha M v

  /// Of implicit Euler only.
  LinearSolverOptions linear_solver;
  TangentProjection projection = TangentProjection::on_demand;
  double linear_tolerance = 1e-8;  ///< of the residual of the linear systems, relative, in (0, 1)
  /// Linearisations per step. 1: the thesis's system; more: Newton's method on the nonlinear step.
  int newton_iterations = 1;
  double newton_tolerance = 1e-8;  ///< |r| over the greatest norm among the forces in it
  int max_halvings = 8;            ///< of a step that fails, before giving up
};

/// One scheme, bound to a model, constraints and a motion, which must outlive it.
class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// The last complete step.
  [[nodiscard]] const MotionState& state() const { return state_; }
  [[nodiscard]] double time() const { return static_cast<double>(state_.step) * options_.step; }

  /// Makes one step. Given equal states, models and numbers of threads the results are equal bit
  /// for bit, whether the state was reached by this object or read from a file.
  /// @throws WorkError  an element that is bad, by its number, or a system that cannot be solved;
  ///                    the state is the last complete step then
  void step();

  /// 1/2 v.M v [J]
  [[nodiscard]] double kinetic_energy() const;

  /// F(u) = -dW/dU at the last complete step [N].
  /// @throws WorkError  an element that is bad
  [[nodiscard]] const Vector& internal_forces();

  /// Forces of the supports on the body, M a + alpha M v - F - load; 0 where free [N].
  [[nodiscard]] Vector reactions();

  /// What linear systems are solved by: another than was asked for after a fall-back.
  [[nodiscard]] virtual LinearSolverKind method() const { return options_.linear_solver.kind; }
  [[nodiscard]] std::int64_t linear_iterations() const { return linear_iterations_; }
  [[nodiscard]] std::int64_t force_evaluations() const { return force_evaluations_; }
  [[nodiscard]] std::int64_t halvings() const { return halvings_; }

 protected:
  /// @param start  a state of this mesh; its constrained values are set to the motion's
  Integrator(Model& model, const Constraints& constraints, const PrescribedMotion& motion,
             const ConstVectorRef& load, const IntegratorOptions& options, MotionState start);

  /// Moves state_.u, v and a from `time` over h; the constrained degrees of freedom as the motion
  /// does.
  /// @throws WorkError  as step(); state_ may then be anything
  virtual void advance(double time, double h) = 0;
  /// Whether a step that failed may go better as two halves.
  [[nodiscard]] virtual bool can_halve() const { return false; }

  /// F(u) at any displacement into `forces`.
  void evaluate_forces(const Vector& u, Vector& forces);
  /// F + load - alpha M v at state_.
  [[nodiscard]] Vector total_forces();
  /// Says that state_.u has changed.
  void forget_forces() { forces_known_ = false; }

  Model& model_;
  const Constraints& constraints_;
  const PrescribedMotion& motion_;
  const Vector load_;
  const IntegratorOptions options_;
  MotionState state_;
  Vector mass_;  // [dof]
  std::int64_t linear_iterations_ = 0;

 private:
  void advance_or_halve(double time, double h, int halvings_left);

  Vector forces_;  // F(state_.u) if forces_known_
  bool forces_known_ = false;
  std::int64_t force_evaluations_ = 0;
  std::int64_t halvings_ = 0;
};

/// The undeformed body at time 0, moving as a whole.
///
/// @param velocity  [dim] of every free degree of freedom [m/s]
[[nodiscard]] MotionState start_of_motion(const Model& model, std::span<const double> velocity);

/// @param load  dead load on all degrees of freedom [N]
/// @throws InputError     wrong options; a free node without mass
/// @throws InternalError  sizes that do not fit the model
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(
    Model& model, const Constraints& constraints, const PrescribedMotion& motion,
    const ConstVectorRef& load, const IntegratorOptions& options, MotionState start);

}  // namespace elastogen
