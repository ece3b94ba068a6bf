// Energy, stress and tangent of a term at one deformation, by the books' formulas.
#pragma once

#include <ginac/ginac.h>

#include <optional>

#include "symgen/law/stress_form.h"

namespace elastogen::symgen {

/// Values in GiNaC's working precision; matrices are 3 x 3.
struct ReferenceState {
  GiNaC::numeric energy;
  GiNaC::matrix stress;         ///< first Piola-Kirchhoff P = dW/dH [Pa]
  GiNaC::matrix stress_change;  ///< dP along a direction dH
};

/// @param gradient    displacement gradient H
/// @param direction   dH
/// @param parameters  values of the parameters' symbols
/// @return            nothing outside the term's domain
[[nodiscard]] std::optional<ReferenceState> reference_state(const GiNaC::ex& term,
                                                            const StressForm& form,
                                                            const GiNaC::matrix& gradient,
                                                            const GiNaC::matrix& direction,
                                                            const GiNaC::exmap& parameters);

/// The term's energy alone.
[[nodiscard]] std::optional<GiNaC::numeric> reference_energy(const GiNaC::ex& term,
                                                             const GiNaC::matrix& gradient,
                                                             const GiNaC::exmap& parameters);

}  // namespace elastogen::symgen
