#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_hexa20() {
  Element element;
  element.name = "hexa20";
  element.shape = ReferenceShape::hexahedron;
  element.coordinates = reference_coordinates();
  element.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                   {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  element.nodes = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  add_mid_edge_nodes(element);
  for (const std::vector<GiNaC::ex>& node : element.nodes) {
    GiNaC::ex function = 1;
    GiNaC::ex sum = -2;  // a corner's function vanishes on the plane through its three neighbours
    bool is_corner = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const GiNaC::ex& x = element.coordinates[i];
      if (node[i].is_zero()) {
        is_corner = false;
        function *= 1 - x * x;
      } else {
        function *= (1 + node[i] * x) / 2;
        sum += node[i] * x;
      }
    }
    element.shape_functions.push_back(is_corner ? function * sum : function);
  }
  element.has_box = true;
  return element;
}

}  // namespace elastogen::symgen
