// From a mesh and parts to element groups: checks of the input, choice of geometry variants.
#pragma once

#include <span>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/mesh.h"
#include "runtime/model.h"

namespace elastogen {

/// @throws InputError, InternalError  as Model's constructor, save for rest shapes
void check_parts(const Mesh& mesh, std::span<const ModelPart> parts, const ModelOptions& options);

/// Batches the elements of parts that were checked: one group per part and geometry variant that
/// occurs, of these one for the elements that share their rest shapes with many others where the
/// options ask for it, and one for the elements at rest. Positions are filled, constants are left
/// empty.
template <class Scalar>
[[nodiscard]] std::vector<ElementGroup<Scalar>> make_element_groups(
    const Mesh& mesh, std::span<const ModelPart> parts, const ModelOptions& options);

}  // namespace elastogen
