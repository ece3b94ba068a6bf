// Generated OpenCL C: one kernel per operation and geometry variant, one work item per element.
#pragma once

#include <string>
#include <vector>

#include "symgen/emit/provenance.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// The source of an association, a program of its own: kernels IDENTIFIER_GEOMETRY_OPERATION, whose
/// arguments and index formulas opencl/prelude.cl explains. It prints the same kernels that
/// print_cpp_header prints; stiffness, which no device solver reads, is left out.
[[nodiscard]] std::string print_opencl(const AssociationId& id, const Provenance& provenance,
                                       const std::vector<VariantKernels>& variants,
                                       const std::vector<VariantReport>& reports);

}  // namespace elastogen::symgen
