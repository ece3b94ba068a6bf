// How wrong an association's compiled kernels are, measured against exact evaluation.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runtime/kernel_abi.h"
#include "selector/certify/case_families.h"
#include "symgen/element_evaluation.h"

namespace elastogen::selector {

/// The operations that are certified, in the order of arrays below; of stress P alone.
inline constexpr std::size_t num_operations = 5;
[[nodiscard]] const char* operation_name(std::size_t operation);

/// What every finite result must stay within, in units of the scalar's epsilon: energy relative to
/// |W|, forces to max |f|, product to max |K| max |V|, stiffness to max |K|, stress to max |P| over
/// all points. Of well-posed families
/// 50, of the energy 200; of others 200 times 1 + the condition of the case, which is sampled and
/// so rather too small.
[[nodiscard]] double error_bound(std::size_t operation, bool well_posed);

/// Errors below so many of the scalar's smallest normal numbers do not count: results there are not
/// normal numbers themselves, or come from products that are not. Nor do errors below what the
/// exact evaluation can tell from 0: 1e10 of its last digits of the stiffness, times lengths.
inline constexpr double underflow_units = 1024;

/// Errors of one operation over the cases of a family.
struct ErrorRecord {
  int num_errors = 0;
  double worst = 0;                               ///< [epsilon]
  double median = 0;                              ///< [epsilon]
  double relative = 0;                            ///< worst error / (1 + condition) [epsilon]
  double condition = 0;                           ///< greatest condition
  std::optional<symgen::ElementCase> worst_case;  ///< that of `relative`
};

struct FamilyRecord {
  std::string family;
  bool well_posed = false;
  int num_cases = 0;
  int flagged = 0;     ///< cases whose status says that a result is not to be used
  int violations = 0;  ///< finite results beyond the bound without a flag
  ErrorRecord errors[num_operations];
  std::string first_violation;  ///< what it was
};

/// All about one association in one precision.
struct Certificate {
  std::string association;
  bool single_precision = false;
  std::vector<std::string> parameter_names;
  std::vector<FamilyRecord> families;

  [[nodiscard]] int violations() const;
  /// Worst error over the well-posed families, or relative to 1 + condition over all others.
  [[nodiscard]] double worst(std::size_t operation, bool well_posed) const;
};

struct CertifyOptions {
  int cases = 20;  ///< of each family
  std::uint32_t seed = 1;
};

/// Evaluates kernels and exact element on the cases of all families. The condition of a case is the
/// greatest change of the exact results, in the same units, when every nodal difference and
/// parameter changes at random by up to one unit in its last place (four trials): what rounding of
/// the inputs alone does.
template <class Scalar>
[[nodiscard]] Certificate certify(const symgen::AssociationId& id, const symgen::Law& law,
                                  const KernelTable<Scalar>& table,
                                  const symgen::ExactElement& exact, const CertifyOptions& options);

}  // namespace elastogen::selector
