// What the generator can make kernels of, beyond what parses.
#pragma once

#include <ginac/ginac.h>

namespace elastogen::symgen {

/// Checks a term of an energy:
/// - exponents are rational numbers p/q with |p| <= 1000 and q <= 64;
/// - numbers lie within 1e-100 ... 1e100 (or are 0);
/// - numbers under a root are positive, their numerator and denominator at most 1e6.
/// @throws InputError  with the subexpression, what is allowed, and the remedy
void check_generable(const GiNaC::ex& term);

}  // namespace elastogen::symgen
