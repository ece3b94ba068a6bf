// Orders of nodes and elements in which passes over a mesh read memory once.
//
// A pass gathers and adds at the nodes of one element after the other. Where neighbours in the body
// are far apart in memory, as in meshes whose generator numbered them as they arose, a million
// tetrahedra take twice to three times as long, ten million nine times (docs/speed.md).
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/vector.h"

namespace elastogen {

/// Which node and which element comes at each place. Elements stay in their blocks.
struct MeshOrder {
  std::vector<std::int32_t> nodes;     ///< [new] = old number
  std::vector<std::int32_t> elements;  ///< [new] = old number, through the blocks
};

/// Elements along a Z-order curve through the bounding box (G. M. Morton, A computer oriented
/// geodetic data base and a new technique in file sequencing, 1966), nodes as the elements come to
/// them; nodes of no element last.
[[nodiscard]] MeshOrder order_along_curve(const Mesh& mesh);

/// The same body in another order.
[[nodiscard]] Mesh reordered(const Mesh& mesh, const MeshOrder& order);

/// A vector of the mesh for the reordered one.
[[nodiscard]] Vector to_order(const MeshOrder& order, const ConstVectorRef& vector);
/// And back.
[[nodiscard]] Vector from_order(const MeshOrder& order, const ConstVectorRef& vector);

}  // namespace elastogen
