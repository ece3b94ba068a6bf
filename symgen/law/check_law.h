// Proves or measures what a constitutive law must have.
#pragma once

#include <string>
#include <vector>

#include "symgen/law/law.h"
#include "symgen/law/moduli.h"
#include "symgen/law/stress_form.h"

namespace elastogen::symgen {

/// How it is known whether a property holds.
enum class Evidence {
  proved,    ///< symbolically, for all parameters and deformations
  measured,  ///< at samples, in long arithmetic
  stated     ///< it does not hold, and the law's file says so
};
[[nodiscard]] std::string evidence_name(Evidence evidence);

struct LawProperty {
  std::string name;  ///< "stress-free at rest"
  std::string term;  ///< name of the law's term; empty: of the whole law
  Evidence evidence = Evidence::proved;
  bool holds = false;  ///< true for `stated`
  std::string detail;  ///< what was found, with the remedy where it does not hold
};

/// Right decimal digits of a term's stress, as kernels compute it in double precision.
struct SmallStrainDigits {
  std::string term;
  bool stabilised = false;  ///< EnergyDensity::stabilised
  std::vector<int> digits;  ///< at `digit_strains()`, 0 ... 16, of the largest component
};

/// 1e-2, 1e-4, ... 1e-10: sizes of the displacement gradient.
[[nodiscard]] const std::vector<double>& digit_strains();

struct LawCheck {
  /// Properties of terms (zero energy at rest, stress-free at rest, objective), then of the law
  /// (stress and tangent, symmetric tangent, positive definite at rest, moduli at rest). Where a
  /// term has no finite tangent at rest, those of terms alone.
  std::vector<LawProperty> properties;
  std::vector<std::string> notes;                    ///< what is worth knowing and is no failure
  StressForm stress;                                 ///< of the whole law
  std::vector<std::vector<GiNaC::ex>> rest_tangent;  ///< 6 x 6, xx yy zz yz xz xy, or empty
  RestModuli moduli;                                 ///< unset where rest_tangent is empty
  std::vector<SmallStrainDigits> digits;  ///< of each term; empty where a term's check failed

  [[nodiscard]] bool holds() const;
};

/// @param law  of `parse_law`
[[nodiscard]] LawCheck check_law(const Law& law);

}  // namespace elastogen::symgen
