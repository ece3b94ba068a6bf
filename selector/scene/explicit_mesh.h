// Meshes whose nodes and elements stand in the scene file.
#pragma once

#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Takes over nodes and elements.
/// @throws InputError  a node number outside the mesh, twice in an element, or in no element; the
///                     same element twice; a face of more than two elements
[[nodiscard]] SceneMesh make_explicit_mesh(const ExplicitMeshDescription& description);

}  // namespace elastogen::selector
