// Where each element leaves its contributions to its nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::opencl {

/// Elements are ranked at each node by their number in the mesh; the rank is the element's slot
/// there. Elements of all blocks share the nodes' slots, whatever their associations.
/// Source: IndexInfluence, X. Faure, thesis, Lyon 2014, tables 4.1-4.3.
struct Slots {
  /// [block][e * nodes_per_element + a]: slot of the block's element e at its node a
  std::vector<std::vector<std::int32_t>> of_elements;
  std::vector<std::int32_t> num_slots;  ///< [node]: elements around it
  std::int32_t max_slots = 0;           ///< partial has max_slots * dim * node_stride numbers
};

[[nodiscard]] Slots number_slots(const Mesh& mesh);

}  // namespace elastogen::opencl
