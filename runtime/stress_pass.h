// The operation `stress` over all elements of a body.
#pragma once

#include <span>

#include "runtime/element_status.h"
#include "runtime/element_system.h"
#include "runtime/stress.h"

namespace elastogen {

/// Where the points of each element begin (StressField::first).
/// @param element_points  [element in the mesh]: how many it has
[[nodiscard]] std::vector<std::size_t> first_points(std::span<const std::int32_t> element_points);

/// Fills the points of all elements, also of those at rest; `field.first` and the size of
/// `field.points` are there already. Points come in the order that the element's own nodes give
/// them, whatever order its geometry variant has put these in.
///
/// @param positions  of the mesh at rest [dim * node + component]
/// @param u          displacement, likewise
/// @throws InternalError  kernels without the operation `stress`
template <class Scalar>
[[nodiscard]] ElementStatus compute_stress(const ElementSystem<Scalar>& elements,
                                           std::span<const double> positions, const double* u,
                                           StressField& field);

}  // namespace elastogen
