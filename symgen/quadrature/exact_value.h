// From symbolic constants to exact numbers.
#pragma once

#include <ginac/ginac.h>

#include "symgen/dag/number.h"

namespace elastogen::symgen {

/// Value of an expression without symbols: rationals, square roots of rationals >= 0, sums,
/// products, integer powers (a quotient is a negative power).
/// @throws InternalError  for anything else, and for a division by zero
[[nodiscard]] ExactNumber exact_value(const GiNaC::ex& expression);

}  // namespace elastogen::symgen
