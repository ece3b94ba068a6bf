// Meshes from files.
#pragma once

#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Reads the file and chooses an association for each kind of element in each region: that of the
/// region's part, else that of the [mesh] table, else the one that the file names.
/// @throws InputError  what is wrong in the file; a part of a region that is not there; elements
///                     without an association, or an association without elements
[[nodiscard]] SceneMesh make_file_mesh(const MeshFileDescription& description);

}  // namespace elastogen::selector
