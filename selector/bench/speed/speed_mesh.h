// Beams to measure on: of any element, in any size, of cubes or distorted.
#pragma once

#include <cstddef>
#include <string>

#include "runtime/mesh.h"
#include "runtime/vector.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// A beam of 8 x 1 x 1 m, as nearly as possible of `elements` elements.
/// @param distorted  inner nodes are moved at random by up to a tenth of a cell, so that every
///                   element has a shape of its own
[[nodiscard]] Mesh make_speed_mesh(const symgen::AssociationId& association, std::size_t elements,
                                   bool distorted);

/// The same body with its nodes and elements numbered at random, in one way only. Of one block.
[[nodiscard]] Mesh shuffled(const Mesh& mesh);

/// A smooth displacement of about a tenth of strain.
[[nodiscard]] Vector bent(const Mesh& mesh);

/// Numbers in (-1, 1), the same at every call.
[[nodiscard]] Vector random_direction(const Mesh& mesh);

}  // namespace elastogen::selector
