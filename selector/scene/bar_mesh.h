// Bars: a regular grid of cells, cut section by section.
#pragma once

#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

/// Divides the bar's cells and cuts them section by section. Nodes are numbered plane by plane
/// from x = 0, which keeps the band of the stiffness matrix small.
/// @throws InputError  when a section does not end on a plane of the grid or when there are too
///                     many nodes
[[nodiscard]] SceneMesh make_bar(const BarDescription& bar);

}  // namespace elastogen::selector
