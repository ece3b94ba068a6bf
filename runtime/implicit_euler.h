// Implicit Euler, linearised once per step or solved by Newton's method.
#pragma once

#include "runtime/integrator.h"

namespace elastogen {

/// u' = u + h v' and M (v' - v) / h = F(u') + load - alpha M v', with F linearised about u:
///   (M - h dF/dV - h^2 dF/dU) dv = h (F + load - alpha M v) + h^2 (dF/dU) v,  dF/dV = -alpha M
/// With more than one iteration per step, Newton's method goes on from there on the nonlinear
/// equation. A dF/dU that leaves the system indefinite is projected
/// (IntegratorOptions::projection), in both places: the scheme keeps its order with any matrix for
/// it. Order 1; damps high frequencies. Source: X. Faure (2014), section 2.6.2; D. Baraff & A.
/// Witkin, Large steps in cloth simulation, SIGGRAPH 1998, eq. 6.
class ImplicitEuler final : public Integrator {
 public:
  ImplicitEuler(Model& model, const Constraints& constraints, const PrescribedMotion& motion,
                const ConstVectorRef& load, const IntegratorOptions& options, MotionState start);

  [[nodiscard]] LinearSolverKind method() const override { return solver_->kind(); }

 private:
  void advance(double time, double h) override;
  [[nodiscard]] bool can_halve() const override { return true; }

  /// x = (K + (1 + h alpha) / h^2 M)^-1 (b - K v) on the free degrees of freedom, K about u.
  /// @param v  may be empty: without that term
  /// @param x  in: a guess
  void solve(const Vector& u, double h, const Vector& b, const Vector& v, Vector& x);
  [[nodiscard]] bool try_solve(const Vector& b, const Vector& v, Vector& x);
  /// Newton's method from the displacement `u` towards the end of a step of length h.
  void iterate(double h, const Vector& before, const Vector& velocity, Vector& u);

  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace elastogen
