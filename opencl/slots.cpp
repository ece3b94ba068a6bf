#include "opencl/slots.h"

#include <algorithm>

namespace elastogen::opencl {

Slots number_slots(const Mesh& mesh) {
  Slots slots;
  slots.num_slots.assign(mesh.num_nodes(), 0);
  for (const ElementBlock& block : mesh.blocks) {
    std::vector<std::int32_t>& of_block = slots.of_elements.emplace_back();
    of_block.reserve(block.nodes.size());
    for (const std::int32_t node : block.nodes) {
      of_block.push_back(slots.num_slots[static_cast<std::size_t>(node)]++);
    }
  }
  for (const std::int32_t count : slots.num_slots) {
    slots.max_slots = std::max(slots.max_slots, count);
  }
  return slots;
}

}  // namespace elastogen::opencl
