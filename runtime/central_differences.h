// Central differences with damping proportional to the mass.
#pragma once

#include "runtime/integrator.h"

namespace elastogen {

///   (M/h^2 + C/2h) u(t+h) = F(u(t)) + load + 2 M/h^2 u(t) - (M/h^2 - C/2h) u(t-h),  C = alpha M
/// which is computed with the velocity v(t) = (u(t+h) - u(t-h)) / 2h as
///   w = v + h/2 (M^-1 (F(u) + load) - alpha v),  u' = u + h w,
///   v' = (w + h/2 M^-1 (F(u') + load)) / (1 + h alpha / 2):
/// the same u, and no past step to keep. Order 2; stable while h < 2 / omega with the greatest
/// frequency omega (runtime/stable_step.h), whatever alpha.
/// Source: C. Checoury (2002), eq. 3.3, whose gamma is -C.
class CentralDifferences final : public Integrator {
 public:
  CentralDifferences(Model& model, const Constraints& constraints, const PrescribedMotion& motion,
                     const ConstVectorRef& load, const IntegratorOptions& options,
                     MotionState start)
      : Integrator(model, constraints, motion, load, options, std::move(start)) {}

 private:
  void advance(double time, double h) override;
};

}  // namespace elastogen
