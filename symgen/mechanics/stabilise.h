// Rewrites a law's term so that nothing cancels near rest: energy, forces and product of kernels
// keep their digits at any strain.
#pragma once

#include <ginac/ginac.h>

#include <optional>

#include "symgen/law/law.h"
#include "symgen/mechanics/small_measures.h"

namespace elastogen::symgen {

/// Runs before any derivative is taken, so that both ways of deriving have it. Preserves the term's
/// value.
///
/// The term is written as a polynomial in deviations (small_measures.h), and the parts of first
/// order are cancelled symbolically. Functions of what is a polynomial in deviations become
/// deviations themselves, with x the relative deviation of their argument, r = log1p_remainder, and
/// e = expm1_remainder:
///   log(1 + x)     = x - r(x)
///   (1 + x)^a - 1  = a x + e(a (x - r(x))) - a r(x)    of rational a; (1 + x)^-1 - 1 = -x + x^2/(1
///   + x) exp(y) - 1     = y + e(y)
/// each remainder of second order without cancellation. So do sums inside products and powers in
/// which first-order parts cancel, such as J^(-2/3) I1 - 3. Powers of one base whose exponents are
/// multiples of one number are powers of one deviation.
struct StabilisedTerm {
  GiNaC::ex value;  ///< over parameters and definitions
  /// No first-order parts are left. False for what has another form (a function whose argument is
  /// no polynomial in invariants and such functions, powers above the eighth): there values are
  /// right, but cancel near rest.
  bool is_stable = false;
};

/// @throws InternalError  for a term that is not stress-free at rest
/// @param by_strain  write it in tr E instead of tr H: for the energy itself, whose derivatives
///                   nobody takes (SmallMeasures)
[[nodiscard]] StabilisedTerm stabilise(const LawTerm& term,
                                       const std::vector<Parameter>& parameters,
                                       const SmallMeasures& measures, bool by_strain);

}  // namespace elastogen::symgen
