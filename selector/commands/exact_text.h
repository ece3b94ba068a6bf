// Exact numbers as text.
#pragma once

#include <ginac/ginac.h>

#include <string>

namespace elastogen::selector {

/// A real number in decimal, correctly rounded to `digits` significant digits (trailing zeros
/// kept): "0.5773502691896257645091487805019574556476". Below 1e-5 and from 10^digits on with an
/// exponent: "1.250e-7".
/// @throws InternalError  when the expression is no real number
[[nodiscard]] std::string decimal_text(const GiNaC::ex& number, int digits);

}  // namespace elastogen::selector
