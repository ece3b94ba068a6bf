// Kernels for evaluation alone: one graph per operation.
#pragma once

#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// Kernels of a loop written out again, for evaluation: energy, forces and product of the element.
[[nodiscard]] VariantKernels written_out(const VariantKernels& kernels);

/// Energy, forces and product as they come from mechanics, without any pass: the reference.
[[nodiscard]] VariantKernels unoptimised_kernels(ElementGraph graph);

/// The same from the thesis's polynomials, every monomial written out.
[[nodiscard]] VariantKernels expanded_kernels(ElementGraph graph);

}  // namespace elastogen::symgen
