// Material parameters of a law: ranges, and values from Young's modulus and Poisson's ratio.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

#include "symgen/law/units.h"

namespace elastogen::symgen {

struct Law;

/// A material parameter of a law.
struct Parameter {
  std::string name;
  std::string unit_name;  ///< as the file has it: "Pa", "N/m^2", "1"
  Unit unit;
  std::string description;
  GiNaC::symbol symbol;
  std::optional<GiNaC::numeric> minimum, maximum;  ///< admissible range, exact
  bool minimum_exclusive = false, maximum_exclusive = false;
  /// How the parameter follows from Young's modulus and Poisson's ratio, as the file has it
  /// ("young*poisson/((1+poisson)*(1-2*poisson))"; empty: it does not) and over
  /// `young_modulus()` and `poisson_ratio()`.
  std::string from_young_poisson;
  GiNaC::ex young_poisson_formula;
};

/// The symbols of Parameter::young_poisson_formula, called `young` [Pa] and `poisson`.
[[nodiscard]] const GiNaC::symbol& young_modulus();
[[nodiscard]] const GiNaC::symbol& poisson_ratio();

/// True if a value lies within the parameter's range.
[[nodiscard]] bool is_admissible(const Parameter& parameter, const GiNaC::numeric& value);

/// Values of a law's parameters from Young's modulus [Pa] and Poisson's ratio, in the law's order;
/// evaluated exactly and rounded once, then checked as by `check_parameters`.
/// @throws InputError  if poisson is not in (-1, 0.5), young is not finite and > 0, or a parameter
///                     does not follow. Messages begin with "poisson = 0.5: ..." and the like, so
///                     that a caller can put file, line and key before them.
[[nodiscard]] std::vector<double> parameters_from_young_poisson(const Law& law, double young,
                                                                double poisson);

/// @param values  in the law's order
/// @throws InputError  if a value is not finite, too small to have all its digits in double
///                     precision, or outside the parameter's range, beginning with "mu = -1: ..."
/// @throws InternalError  if there are more or fewer values than parameters
void check_parameters(const Law& law, const std::vector<double>& values);

}  // namespace elastogen::symgen
