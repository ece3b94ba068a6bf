// Elastic moduli of a law at rest, and for which parameters they make a sound solid.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symgen/law/law.h"

namespace elastogen::symgen {

/// Lame parameters of the tangent at rest, over the parameters' symbols [Pa]. Every law in
/// invariants is isotropic at rest, so these two are its whole tangent on symmetric strains.
struct RestModuli {
  GiNaC::ex lambda, mu;
};

/// @param tangent  of `rest_tangent`, summed over the law's terms
[[nodiscard]] RestModuli moduli_of(const std::vector<GiNaC::ex>& tangent);

/// True if all parameters follow from Young's modulus and Poisson's ratio.
[[nodiscard]] bool follows_from_young_poisson(const Law& law);

/// Symbols `young` and `poisson` and the Lame parameters that they mean.
struct YoungPoisson {
  GiNaC::symbol young = GiNaC::symbol("young"), poisson = GiNaC::symbol("poisson");
  [[nodiscard]] RestModuli moduli() const;
  /// Expressions for the parameters' symbols. @pre follows_from_young_poisson(law)
  [[nodiscard]] GiNaC::exmap parameters(const Law& law) const;
};

/// Admissible parameter values and how they were chosen.
struct ParameterSample {
  std::string text;  ///< "young = 1, poisson = 1/4"
  GiNaC::exmap values;
};

/// Samples, each within all declared ranges: from Young's modulus 1 and Poisson's ratios between -1
/// and 1/2 where the parameters follow from them; else from bounds, values near them and values far
/// from them (a fixed random choice where there are many combinations). Empty: none was found.
[[nodiscard]] std::vector<ParameterSample> admissible_samples(const Law& law);

/// True if it is plain that an expression in the parameters is positive within their ranges: a
/// quotient of sums of products with positive coefficients of parameters that are not negative.
[[nodiscard]] bool is_plainly_positive(const GiNaC::ex& expression, const Law& law);

}  // namespace elastogen::symgen
