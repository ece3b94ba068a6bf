#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_tet10() {
  Element element;
  element.name = "tet10";
  element.shape = ReferenceShape::tetrahedron;
  element.coordinates = reference_coordinates();
  element.edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  element.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_mid_edge_nodes(element);
  // In barycentric coordinates L: L (2 L - 1) at a corner, 4 L L' in the middle of an edge.
  const GiNaC::ex xi = element.coordinates[0];
  const GiNaC::ex eta = element.coordinates[1];
  const GiNaC::ex mu = element.coordinates[2];
  const std::vector<GiNaC::ex> barycentric = {1 - xi - eta - mu, xi, eta, mu};
  for (const GiNaC::ex& l : barycentric) element.shape_functions.push_back(l * (2 * l - 1));
  for (const auto& [a, b] : element.edges) {
    element.shape_functions.push_back(4 * barycentric[a] * barycentric[b]);
  }
  element.has_affine = true;
  return element;
}

}  // namespace elastogen::symgen
