#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_tri3() {
  Element element;
  element.name = "tri3";
  element.shape = ReferenceShape::triangle;
  element.dim = 2;
  element.coordinates = reference_coordinates(2);
  const GiNaC::ex xi = element.coordinates[0];
  const GiNaC::ex eta = element.coordinates[1];
  element.nodes = {{0, 0}, {1, 0}, {0, 1}};
  element.shape_functions = {1 - xi - eta, xi, eta};
  element.affine = true;
  return element;
}

}  // namespace elastogen::symgen
