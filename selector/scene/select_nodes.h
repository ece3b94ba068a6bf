// Nodes by position.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/mesh.h"
#include "selector/scene/scene.h"

namespace elastogen::selector {

/// Nodes inside a selection, with a tolerance of 1e-6 of the mesh's greatest extent; ascending.
/// @throws InputError  when there are none; says where the mesh lies
[[nodiscard]] std::vector<std::int32_t> select_nodes(const Mesh& mesh,
                                                     const NodeSelection& selection);

}  // namespace elastogen::selector
