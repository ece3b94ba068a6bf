// Generated C++: kernel templates over the scalar type.
#pragma once

#include <string>
#include <vector>

#include "symgen/emit/provenance.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// The header of an association: one namespace per geometry variant, one function template per
/// operation. Fills in code_bytes of the reports.
[[nodiscard]] std::string print_cpp_header(const AssociationId& id, const Provenance& provenance,
                                           const std::vector<VariantKernels>& variants,
                                           std::vector<VariantReport>& reports);

/// See registration_source in pipeline.h.
[[nodiscard]] std::string print_cpp_registration(const AssociationId& id,
                                                 const std::vector<std::string>& parameter_names,
                                                 const std::vector<std::string>& geometries,
                                                 const Instantiation& what);

}  // namespace elastogen::symgen
