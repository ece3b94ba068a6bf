// Exact and long numbers in decimal.
#pragma once

#include <cln/cln.h>

#include <string>

namespace elastogen::symgen {

/// A real number in decimal, rounded to nearest at `digits` significant digits, trailing zeros
/// kept: "0.5773502691896257645091487805019574556476". Below 1e-5 and from 10^digits on with an
/// exponent: "1.250e-7".
[[nodiscard]] std::string decimal_text(const cln::cl_R& number, int digits);

}  // namespace elastogen::symgen
