// Whether a law is stable at given values of its parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symgen/law/law.h"

namespace elastogen::symgen {

/// Lame parameters of the tangent at rest [Pa].
struct ModuliAtRest {
  double lambda = 0, mu = 0;

  /// The eigenvalues of the tangent, 2 mu and 3 lambda + 2 mu, are positive.
  [[nodiscard]] bool is_stable() const { return mu > 0 && 3 * lambda + 2 * mu > 0; }
  /// In (-1, 0.5) where stable.
  [[nodiscard]] double poisson() const { return lambda / (2 * (lambda + mu)); }
};

/// @param parameters  values in the law's order
/// @return            nothing where the tangent at rest is not finite
[[nodiscard]] std::optional<ModuliAtRest> moduli_at_rest(const Law& law,
                                                         const std::vector<double>& parameters);

/// Where a deformation first makes a law unstable.
struct UnstableStretch {
  std::string mode;    ///< "uniaxial tension"
  double stretch = 1;  ///< principal stretch along the first axis
};

/// Follows uniaxial tension (to twice the length) and compression (to half of it), equibiaxial
/// tension and pure shear, all without change of volume, and tests Drucker's postulate: every
/// increment of logarithmic strain that keeps the volume must do positive work on the increment of
/// Kirchhoff stress that it causes. Names the modes in which it does not, with the stretch to three
/// digits.
///
/// @param parameters  values in the law's order, at which the law is stable at rest
/// Source: Abaqus Theory Manual, 4.6.1, hyperelastic material behavior.
[[nodiscard]] std::vector<UnstableStretch> unstable_stretches(
    const Law& law, const std::vector<double>& parameters);

}  // namespace elastogen::symgen
