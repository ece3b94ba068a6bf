#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_hexa8() {
  Element element;
  element.name = "hexa8";
  element.shape = ReferenceShape::hexahedron;
  element.coordinates = reference_coordinates();
  element.nodes = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  for (const std::vector<GiNaC::ex>& node : element.nodes) {
    GiNaC::ex function = GiNaC::numeric(1, 8);
    for (std::size_t i = 0; i < 3; ++i) function *= 1 + node[i] * element.coordinates[i];
    element.shape_functions.push_back(function);
  }
  element.has_box = true;
  return element;
}

}  // namespace elastogen::symgen
