// The order in which passes over a mesh come to its elements.
//
// A pass gathers and adds at the nodes of one element after the other. Where neighbours in the body
// are far apart in memory, as in meshes whose generator numbered them as they arose, a million
// tetrahedra take six times as long, ten million nine times (docs/speed.md).
#pragma once

#include <span>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/model.h"

namespace elastogen {

/// Whether passes over the parts' elements, in their order, read nodes anew, after these have left
/// a second cache, more than twice for every node of the mesh. Ordered meshes read each line of
/// eight numbers once or a little more; those of mesh generators were seen to read 3 to 11 lines
/// per node.
[[nodiscard]] bool is_scattered(const Mesh& mesh, std::span<const ModelPart> parts);

/// The parts with their elements along a Z-order curve through the bounding box (G. M. Morton, A
/// computer oriented geodetic data base and a new technique in file sequencing, 1966).
[[nodiscard]] std::vector<ModelPart> along_curve(const Mesh& mesh,
                                                 std::span<const ModelPart> parts);

}  // namespace elastogen
