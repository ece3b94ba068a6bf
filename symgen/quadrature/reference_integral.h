// Exact integrals over reference elements.
#pragma once

#include <ginac/ginac.h>

#include "symgen/element/element.h"

namespace elastogen::symgen {

/// Integral over the reference element of a function of `element.coordinates`: a polynomial, or on
/// the pyramid whatever the conical coordinates xi = (1 - z) u, eta = (1 - z) v, mu = z make a
/// polynomial together with their Jacobian (1 - z)^2, as they do the shape functions' gradients.
/// Other symbols are constants.
/// @throws InternalError  if the function is not of that kind
[[nodiscard]] GiNaC::ex integrate_over_reference(const Element& element, const GiNaC::ex& function);

}  // namespace elastogen::symgen
