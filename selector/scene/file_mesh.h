// Meshes from files.
#pragma once

#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Takes the mesh that was read and chooses an association for each kind of element in each region:
/// that of the region's part, else that of the [mesh] table, else the one that the file names.
/// @throws InputError  a part of a region that is not there; elements
///                     without an association, or an association without elements
[[nodiscard]] SceneMesh make_file_mesh(const MeshFileDescription& description);

}  // namespace elastogen::selector
