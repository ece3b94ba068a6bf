// The thick sphere under pressure, solved along its radius: a reference for any isotropic law.
#pragma once

#include <span>
#include <vector>

#include "symgen/law/law.h"

namespace elastogen::selector {

struct RadialProblem {
  double inner = 0, outer = 0;     ///< radii at rest [m]
  double pressure = 0;             ///< on the inner surface, a dead load on the rest surface [Pa]
  std::vector<double> parameters;  ///< of the law, in its order
};

/// u(R), the radial displacement of a point at rest at radius R.
///
/// It minimises the potential of the sphere that stays a sphere,
///   Pi[u] = integral of W(1 + u', 1 + u/R, 1 + u/R) R^2 dR - p a^2 u(a),  per solid angle,
/// over polynomials of degree 24, whose coefficients converge exponentially: u is found to better
/// than 1e-10 of its largest value, which the solution with a degree of 32 is compared for.
/// At small strain it is Lame's (Timoshenko & Goodier, Theory of elasticity, 3rd ed., section 136).
class RadialSphere {
 public:
  /// @throws WorkError  where no equilibrium is found, or not to 1e-10
  RadialSphere(const symgen::Law& law, const RadialProblem& problem);

  /// @param radius  at rest, in [inner, outer] [m]
  [[nodiscard]] double displacement(double radius) const;

 private:
  RadialProblem problem_;
  std::vector<double> coefficients_;  // of Chebyshev polynomials of (2 R - a - b) / (b - a)
};

}  // namespace elastogen::selector
