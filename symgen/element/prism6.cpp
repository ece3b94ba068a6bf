#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_prism6() {
  Element element;
  element.name = "prism6";
  element.shape = ReferenceShape::prism;
  element.coordinates = reference_coordinates();
  const GiNaC::ex xi = element.coordinates[0];
  const GiNaC::ex eta = element.coordinates[1];
  const GiNaC::ex mu = element.coordinates[2];
  element.nodes = {{-1, 1, 0}, {-1, 0, 1}, {-1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 0, 0}};
  for (const GiNaC::ex& along : {(1 - xi) / 2, (1 + xi) / 2}) {
    for (const GiNaC::ex& across : {eta, mu, 1 - eta - mu}) {
      element.shape_functions.push_back(across * along);
    }
  }
  return element;
}

}  // namespace elastogen::symgen
