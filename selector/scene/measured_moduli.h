// Young's modulus and Poisson's ratio measured back from a bar that was pulled.
#pragma once

#include <optional>

#include "selector/scene/body_state.h"

namespace elastogen::selector {

/// Secant moduli at the stretch that was reached; what was not asked for is left out.
struct MeasuredModuli {
  double strain = 0;            ///< of the whole bar, dL / L
  std::optional<double> young;  ///< [Pa]
  std::optional<double> poisson;
};

/// From a bar [0, L] x [0, W] x [0, H] that is pulled or pressed along x:
///   E = F L / (W H dL)                      (X. Faure, 2014, eq. 5.2)
///   nu = -(dW / W + dH / H) / 2 / (dx)      in the middle of the bar
/// F is the force that holds the end x = 0, dL the difference of both ends' mean displacements, dW
/// and dH those of opposite sides in the section in the middle, dx the strain along x between the
/// sections beside that one: so E needs uniform stress, nu a middle that the ends do not disturb.
/// A bar that was not stretched at all has neither.
[[nodiscard]] MeasuredModuli measure_moduli(const Scene& scene, const Problem& problem,
                                            const BodyState& state);

/// @throws InputError  when the scene measures Poisson's ratio on a bar without a section between
///                     its ends
void check_measurable(const Scene& scene, const Problem& problem);

}  // namespace elastogen::selector
