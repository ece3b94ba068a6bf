// From linear elements to quadratic ones: a node in the middle of every edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// A node in the middle of the edge between two others.
struct MidEdgeNode {
  std::int32_t node = 0;
  std::int32_t a = 0, b = 0;  ///< ends of the edge, a < b
};

/// Makes the elements of one block those of a quadratic element of the same corners.
struct QuadraticBlock {
  std::size_t block = 0;  ///< index into Mesh::blocks
  std::string element;    ///< "tet10", whose ElementTopology::linear the block has
};

/// Adds a node in the middle of every edge of the named blocks and turns their elements into
/// quadratic ones. Elements that share an edge share its node, also between blocks, so that they
/// fit together; linear elements beside them keep their corners only. New nodes stand behind all
/// others, in the order in which the elements come to them.
///
/// @return the new nodes, ascending: to put one onto a curved surface, move its position
/// @throws InternalError  when a block does not have the linear element of the same corners
std::vector<MidEdgeNode> add_mid_edge_nodes(Mesh& mesh, const std::vector<QuadraticBlock>& blocks);

}  // namespace elastogen::selector
