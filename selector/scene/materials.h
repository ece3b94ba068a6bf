// From a scene's materials to the parameters of laws.
#pragma once

#include <vector>

#include "selector/scene/scene.h"
#include "selector/scene/scene_mesh.h"
#include "symgen/law/law.h"

namespace elastogen::selector {

/// Material of each of the mesh's blocks, as an index into `materials`.
/// @throws InputError  a region without material, or a material for a region that does not exist
[[nodiscard]] std::vector<std::size_t> materials_of_blocks(
    const std::vector<MaterialDescription>& materials, const std::vector<SceneMesh::Block>& blocks);

/// Checks the keys of a material that goes with these laws.
/// @throws InputError  for a key that none of them has
void check_material_keys(const MaterialDescription& material,
                         const std::vector<const symgen::Law*>& laws);

/// A law's parameters, in its order: from `young` and `poisson`, or each by its own name.
/// @throws InputError  a missing parameter, one outside its range, a Poisson ratio outside
///                     (-1, 0.5), or both ways mixed
[[nodiscard]] std::vector<double> law_parameters(const MaterialDescription& material,
                                                 const symgen::Law& law);

}  // namespace elastogen::selector
