#include <gtest/gtest.h>

#include "opencl/slots.h"

namespace elastogen::opencl {
namespace {

/// The six triangles of the thesis's example: nodes from table 4.1, slots from table 4.3, numbers
/// of elements around a node from table 4.2.
TEST(Slots, AreThoseOfTheThesisExample) {
  Mesh mesh;
  mesh.dim = 2;
  mesh.positions.assign(2 * 8, 0.0);
  mesh.blocks.push_back(
      {"tri3", 3, {0, 4, 5, 0, 1, 5, 1, 2, 5, 2, 5, 6, 2, 3, 6, 3, 6, 7}, {0, 0, 0, 0, 0, 0}});
  const Slots slots = number_slots(mesh);
  EXPECT_EQ(slots.of_elements[0], (std::vector<std::int32_t>{0, 0, 0, 1, 0, 1, 1, 0, 2,  //
                                                             1, 3, 0, 2, 0, 1, 1, 2, 0}));
  EXPECT_EQ(slots.num_slots, (std::vector<std::int32_t>{2, 2, 3, 2, 1, 4, 3, 1}));
  EXPECT_EQ(slots.max_slots, 4);
}

}  // namespace
}  // namespace elastogen::opencl
