// Nodes by position, or by the name of a boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "selector/scene/scene.h"
#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Nodes inside a selection, with a tolerance of 1e-6 of the mesh's greatest extent; ascending.
/// @throws InputError  when there are none; says where the mesh lies, or which boundaries it has
[[nodiscard]] std::vector<std::int32_t> select_nodes(const SceneMesh& mesh,
                                                     const NodeSelection& selection);

/// The boundary that a selection names.
/// @throws InputError  when the mesh does not have it; names the nearest
[[nodiscard]] const MeshBoundary& find_boundary(const SceneMesh& mesh,
                                                const NodeSelection& selection);

}  // namespace elastogen::selector
