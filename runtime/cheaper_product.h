// The choice of how products with the tangent are computed.
#pragma once

#include <vector>

#include "runtime/element_group.h"
#include "runtime/tangent.h"

namespace elastogen {

/// recompute or two_stage: what costs less for the elements of all groups, in operations of their
/// kernels (VariantTable::costs) and numbers of state that are stored and read. It depends on the
/// mesh and the laws alone, not on a clock: the same on every machine.
/// @param products_per_tangent  products that follow a linearisation
template <class Scalar>
[[nodiscard]] TangentProduct cheaper_product(const std::vector<ElementGroup<Scalar>>& groups,
                                             double products_per_tangent);

}  // namespace elastogen
