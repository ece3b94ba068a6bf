// From a mesh and parts to element groups: checks of the input, choice of geometry variants.
#pragma once

#include <span>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/mesh.h"
#include "runtime/model.h"

namespace elastogen {

/// Checks mesh and parts and batches the elements: one group per part and geometry variant that
/// occurs. Positions are filled, constants are left empty.
///
/// @throws InputError, InternalError  as Model's constructor, save for rest shapes
[[nodiscard]] std::vector<ElementGroup> make_element_groups(const Mesh& mesh,
                                                            std::span<const ModelPart> parts,
                                                            TangentProduct tangent_product);

}  // namespace elastogen
