// Generated C++: kernel templates over the scalar type.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symgen/emit/provenance.h"
#include "symgen/mechanics/reference_points.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// The header of an association: one namespace per geometry variant, one function template per
/// operation. Fills in code_bytes of the reports.
[[nodiscard]] std::string print_cpp_header(const AssociationId& id, const Provenance& provenance,
                                           const std::vector<VariantKernels>& variants,
                                           std::vector<VariantReport>& reports);

/// What a registration source says of an association beside its kernels.
struct Registration {
  AssociationId id;
  std::vector<std::string> parameter_names, geometries;
  ReferencePoints points;
  std::optional<ReferencePoints> rich_points;  ///< none: the same as `points`
};

/// See registration_source in pipeline.h.
[[nodiscard]] std::string print_cpp_registration(const Registration& registration,
                                                 const Instantiation& what);

}  // namespace elastogen::symgen
