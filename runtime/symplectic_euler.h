// Symplectic Euler: velocities from old forces, positions from new velocities.
#pragma once

#include "runtime/integrator.h"

namespace elastogen {

///   v' = (v + h M^-1 (F(u) + load)) / (1 + h alpha),  u' = u + h v'
/// Order 1. Without damping the energy oscillates but does not drift while h < 2 / omega with the
/// greatest frequency omega (runtime/stable_step.h); damping, taken at v', only widens that.
/// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., eq. I.1.9
class SymplecticEuler final : public Integrator {
 public:
  SymplecticEuler(Model& model, const Constraints& constraints, const PrescribedMotion& motion,
                  const ConstVectorRef& load, const IntegratorOptions& options, MotionState start)
      : Integrator(model, constraints, motion, load, options, std::move(start)) {}

 private:
  void advance(double time, double h) override;
};

}  // namespace elastogen
