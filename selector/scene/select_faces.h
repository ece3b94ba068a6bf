// Faces of the body's surface, by position or by the name of a boundary.
#pragma once

#include <vector>

#include "runtime/surface_loads.h"
#include "selector/scene/scene.h"
#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Faces of a boundary, or faces on the surface all of whose nodes are selected; turned outwards by
/// the element that they belong to, whatever their direction in the file.
/// @throws InputError  when there are none, or when a boundary has a face inside the body
[[nodiscard]] std::vector<SurfaceFace> select_faces(const SceneMesh& mesh,
                                                    const NodeSelection& selection);

}  // namespace elastogen::selector
