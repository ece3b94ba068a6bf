// Measures of deformation that vanish at rest, of known order, and computed without cancellation.
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {

/// Something that vanishes at rest, d = slope * (one measure of first order) + remainder, the
/// remainder of second order and known to rounding relative to itself.
struct Deviation {
  GiNaC::symbol symbol;  ///< d
  GiNaC::ex slope;       ///< over parameters; 0 for what is of second order itself
  GiNaC::ex remainder;   ///< over the definitions
  GiNaC::ex value;       ///< d itself over the definitions, where that is not the symbol
};

/// With t = tr H, q = |H|^2, k = minors(H) + det H and s = minors(E), E the Green-Lagrange strain:
///   tr E = t + q/2,  J - 1 = t + k,  I1 - 3 = 2 t + q,  I2 - 3 = 4 t + 2 q + 4 s.
///
/// In t deformations that are small keep their digits, and those that are large; but after a finite
/// rotation t, q and k are not small and cancel. In tr E they do not: with d = det E,
/// c = det C - 1 = 2 tr E + 4 s + 8 d = j (2 + j) it is
///   j = tr E - a,  a = (tr E j - 4 s - 8 d) / (2 + j),
/// and for J < 0, where the same holds of |J|, a = tr E - (|J| - 1) + |J| - J. That costs more, so
/// it serves the energy alone; stresses, of first order, lose no more in t than a rotation's
/// rounding costs anyway.
struct SmallMeasures {
  std::vector<Definition> definitions;
  GiNaC::symbol volume_change;         ///< j = J - 1
  GiNaC::symbol i1_change;             ///< I1 - 3
  GiNaC::symbol i2_change;             ///< I2 - 3
  std::vector<Deviation> by_gradient;  ///< slopes and remainders in t
  std::vector<Deviation> by_strain;    ///< the same deviations in tr E
};

[[nodiscard]] SmallMeasures small_measures(int dim);

}  // namespace elastogen::symgen
