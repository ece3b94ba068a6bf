#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_quad4() {
  Element element;
  element.name = "quad4";
  element.shape = ReferenceShape::quadrilateral;
  element.dim = 2;
  element.coordinates = reference_coordinates(2);
  element.nodes = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const std::vector<GiNaC::ex>& node : element.nodes) {
    GiNaC::ex function = GiNaC::numeric(1, 4);
    for (std::size_t i = 0; i < 2; ++i) function *= 1 + node[i] * element.coordinates[i];
    element.shape_functions.push_back(function);
  }
  element.has_box = true;
  return element;
}

}  // namespace elastogen::symgen
