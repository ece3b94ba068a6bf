#include "selector/mesh_readers/gmsh_elements.h"

#include <algorithm>

namespace elastogen::selector {

const std::vector<GmshElement>& gmsh_elements() {
  // The reference coordinates differ (our prism lies along xi, our pyramid's base is turned by 45
  // degrees), yet the nodes are met in the same order: base, turning about the way to the top, top.
  static const std::vector<GmshElement> elements = {
      {2, "tri3", {0, 1, 2}, {0, 2, 1}},
      {3, "quad4", {0, 1, 2, 3}, {0, 3, 2, 1}},
      {4, "tet4", {0, 1, 2, 3}, {0, 2, 1, 3}},
      {5, "hexa8", {0, 1, 2, 3, 4, 5, 6, 7}, {0, 3, 2, 1, 4, 7, 6, 5}},
      {6, "prism6", {0, 1, 2, 3, 4, 5}, {0, 2, 1, 3, 5, 4}},
      {7, "pyramid5", {0, 1, 2, 3, 4}, {0, 3, 2, 1, 4}},
      // Gmsh has the last two edges of a tetrahedron as 23, 13, and those of a hexahedron sorted.
      {11, "tet10", {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}, {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
      {17,
       "hexa20",
       {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15},
       {0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17}},
  };
  return elements;
}

const GmshElement* find_gmsh_element(std::int32_t type) {
  const auto& elements = gmsh_elements();
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&](const GmshElement& e) { return e.type == type; });
  return found == elements.end() ? nullptr : &*found;
}

}  // namespace elastogen::selector
