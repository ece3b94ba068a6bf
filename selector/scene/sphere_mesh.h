// An eighth of a thick sphere as a mesh.
#pragma once

#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Meshes the part x, y, z >= 0 of a thick sphere about the origin. The surface is divided from the
/// planes x + y + z = constant by projection from the centre: into n^2 triangles for prism6 and
/// tet4 (prisms cut in three, which fit each other), into 3 n^2 quadrilaterals around its middle
/// for hexa8 and pyramid5. Layers have radii in geometric progression, so that cells keep their
/// shape. Quadratic elements have the corners of the linear ones, and edges that follow the
/// spheres. Boundaries "inner" and "outer" have the two surfaces' nodes and faces.
///
/// @throws InputError  for an element that it cannot be cut into; says which it can
[[nodiscard]] SceneMesh make_sphere(const SphereDescription& sphere);

}  // namespace elastogen::selector
