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

/// Tangent dP/dH at H = 0 of all terms, [(i * 3 + j) * 9 + k * 3 + l]; empty where it is not
/// finite.
[[nodiscard]] std::vector<GiNaC::ex> rest_tangent_of(const Law& law);

/// @param tangent  of `rest_tangent_of`, not empty
[[nodiscard]] RestModuli moduli_of(const std::vector<GiNaC::ex>& tangent);

/// True if all parameters follow from Young's modulus and Poisson's ratio.
[[nodiscard]] bool follows_from_young_poisson(const Law& law);

/// The Lame parameters that Young's modulus and Poisson's ratio mean, over their symbols.
[[nodiscard]] RestModuli moduli_of_young_poisson();

/// What the parameters' symbols are in Young's modulus and Poisson's ratio.
/// @pre follows_from_young_poisson(law)
[[nodiscard]] GiNaC::exmap parameters_of_young_poisson(const Law& law);

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
