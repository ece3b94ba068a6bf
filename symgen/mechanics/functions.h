// Functions that GiNaC lacks: remainder primitives that stay exact at small strain.
#pragma once

#include <ginac/ginac.h>

namespace elastogen::symgen {

/// log1p(x) = log(1 + x), real for x > -1; derivative 1/(1 + x). Zero at 0; otherwise kept as it
/// is until evalf, which is accurate to the last digits of GiNaC::Digits however small x is.
DECLARE_FUNCTION_1P(log1p)

/// log1p_remainder(x) = x - log(1 + x) = x^2/2 - x^3/3 + ..., of second order; derivative
/// x/(1 + x). Zero at 0; evalf is accurate relative to the value itself, not to x.
DECLARE_FUNCTION_1P(log1p_remainder)

/// expm1_remainder(y) = exp(y) - 1 - y = y^2/2 + y^3/6 + ..., of second order; derivative
/// exp(y) - 1, written y + expm1_remainder(y). Zero at 0; evalf as of log1p_remainder.
DECLARE_FUNCTION_1P(expm1_remainder)

/// negative_part(x) = max(0, -x); of values whose derivatives nobody takes.
DECLARE_FUNCTION_1P(negative_part)

}  // namespace elastogen::symgen
