// Figures of X. Faure, thesis, Lyon 2014, section 6.3.4: the beam and its torsion.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace elastogen::selector {

/// Table 6.6: mean distance of a beam's deflection to the analytic solution [m], Saint-Venant
/// Kirchhoff. The beam is 8 x 1 x 1 m, E = 100 MPa, nu = 0, rho = 1000 kg/m^3, clamped at x = 0.
/// "MMT" is the thesis's method (tensor mass), which our kernels are the descendants of.
struct ThesisDistances {
  std::string_view program;  ///< "MMT", "Abaqus"
  std::size_t num_elements = 0;
  double hexahedra = 0, prisms = 0, pyramids = 0, tetrahedra = 0;  ///< NaN: Abaqus has no pyramids

  /// @param element  "hexa8", "prism6", "pyramid5", "tet4"; NaN for any other
  [[nodiscard]] double of(std::string_view element) const;
};

[[nodiscard]] const std::array<ThesisDistances, 5>& thesis_table_6_6();

/// Table 6.7: distance of a bar's nodes to those of Abaqus after torsion by half a turn [m].
struct ThesisTorsion {
  std::string_view method;
  double mean = 0, maximum = 0, minimum = 0;
};

[[nodiscard]] const std::array<ThesisTorsion, 3>& thesis_table_6_7();

/// The thesis's analytic deflection u_z [m] at x [m]: the line of Euler and Bernoulli for a beam of
/// square section H under its weight,
///   u_z(x) = -rho g / (2 E H^2) (6 L^2 x^2 - 4 L x^3 + x^4),
/// with g = 9.81 m/s^2; u_z(8) = -0.60273. Thesis, equation 5.3, where H^4 and x^2 in the second
/// term are misprints: the units of neither are right. The line leaves out shear and large
/// displacements: the converged beam in three dimensions has u_z(8) = -0.6076.
[[nodiscard]] double thesis_deflection(double x);

}  // namespace elastogen::selector
