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
  /// The same values for the energy itself, in a form whose derivatives are not to be taken but
  /// that keeps its digits after finite rotations, too.
  std::vector<GiNaC::ex> values;
  /// [law term] true: no first-order parts are left that would cancel near rest, so energy, forces
  /// and product keep their digits at any strain.
  std::vector<bool> stabilised;
};

struct EnergyOptions {
  /// Rewrite each term so that nothing cancels near rest (stabilise.h). Off: the textbook form, for
  /// comparison.
  bool stabilise = true;
};

/// Builds W(H) from the law's terms; dim is 3, or 2 for plane strain. Functions that may appear in
/// the result beside GiNaC's own are those of mechanics/functions.h.
[[nodiscard]] EnergyDensity energy_density(const Law& law, int dim, const EnergyOptions& options);

/// Substitutes all definitions: term `l` as one GiNaC expression in `gradient` and the law's
/// parameters. For checks and reference derivatives, not for emission.
[[nodiscard]] GiNaC::ex flatten_term(const EnergyDensity& energy, std::size_t l);

}  // namespace elastogen::symgen
