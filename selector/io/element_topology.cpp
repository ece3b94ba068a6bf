#include "selector/io/element_topology.h"

#include <fmt/format.h>
#include <vtkCellType.h>

#include "runtime/error.h"

namespace elastogen::selector {

const std::vector<ElementTopology>& element_topologies() {
  static const std::vector<ElementTopology> topologies = {
      // VTK wants the first triangle of a wedge to face away from the second, ours faces it.
      {"prism6",
       "prisms",
       3,
       6,
       VTK_WEDGE,
       {0, 2, 1, 3, 5, 4},
       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {"pyramid5",
       "pyramids",
       3,
       5,
       VTK_PYRAMID,
       {0, 1, 2, 3, 4},
       {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {"hexa8",
       "hexahedra",
       3,
       8,
       VTK_HEXAHEDRON,
       {0, 1, 2, 3, 4, 5, 6, 7},
       {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {"tet4",
       "tetrahedra",
       3,
       4,
       VTK_TETRA,
       {0, 1, 2, 3},
       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
      {"quad4", "quadrilaterals", 2, 4, VTK_QUAD, {0, 1, 2, 3}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {"tri3", "triangles", 2, 3, VTK_TRIANGLE, {0, 1, 2}, {{0, 1}, {1, 2}, {2, 0}}},
  };
  return topologies;
}

const ElementTopology& element_topology(const std::string& element) {
  std::string known;
  for (const ElementTopology& topology : element_topologies()) {
    if (topology.element == element) return topology;
    if (!known.empty()) known += ", ";
    known += topology.element;
  }
  throw InputError(
      fmt::format("element '{}' cannot be used in a mesh: these can: {}", element, known));
}

}  // namespace elastogen::selector
