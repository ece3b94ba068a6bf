#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_tet4() {
  Element element;
  element.name = "tet4";
  element.shape = ReferenceShape::tetrahedron;
  element.coordinates = reference_coordinates();
  const GiNaC::ex xi = element.coordinates[0];
  const GiNaC::ex eta = element.coordinates[1];
  const GiNaC::ex mu = element.coordinates[2];
  element.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  element.shape_functions = {1 - xi - eta - mu, xi, eta, mu};
  element.affine = true;
  return element;
}

}  // namespace elastogen::symgen
