// From a law to its energy density as a function of the displacement gradient.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symgen/law/law.h"
#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {

/// Energy density of a law per rest volume, W(H) [J/m^3], as nested definitions.
struct EnergyDensity {
  int dim = 3;
  std::vector<GiNaC::symbol> gradient;  ///< H[i * dim + j] = dU_i/dX_j; dimensionless
  std::vector<Definition> definitions;  ///< in order of use; only those that some term needs
  std::vector<GiNaC::ex> terms;         ///< [law term], over parameters and definitions
  /// [law term] true: no first-order parts are left that would cancel near rest, so energy, forces
  /// and product keep their digits at any strain.
  std::vector<bool> stabilised;
};

struct EnergyOptions {
  /// Write the energy in variables of known order (t = tr H, q = |H|^2, k = det(I + H) - 1 - t)
  /// with remainder functions, first-order parts cancelled symbolically: exact to rounding at any
  /// strain without finite rotation (with one, the energy's parts have the rotation's size). Done
  /// for terms that are polynomials in the invariants and log(J); in others log(J) becomes log1p(J
  /// - 1) with J - 1 formed from H, and nothing else is rewritten. Off: the textbook form, for
  /// comparison.
  bool stabilise = true;
};

/// Builds W(H) from the law's terms; dim is 3, or 2 for plane strain. Functions that may appear in
/// the result beside GiNaC's own: log1p(x) and log1p_remainder(x) = x - log(1 + x), both registered
/// in mechanics/functions.h.
[[nodiscard]] EnergyDensity energy_density(const Law& law, int dim, const EnergyOptions& options);

/// Substitutes all definitions: term `l` as one GiNaC expression in `gradient` and the law's
/// parameters. For checks and reference derivatives, not for emission.
[[nodiscard]] GiNaC::ex flatten_term(const EnergyDensity& energy, std::size_t l);

}  // namespace elastogen::symgen
