#include "symgen/mechanics/rest_shape.h"

#include "runtime/error.h"
#include "symgen/dag/lower.h"

namespace elastogen::symgen {

std::string geometry_name(Geometry geometry) {
  switch (geometry) {
    case Geometry::general:
      return "general";
    case Geometry::affine:
      return "affine";
    case Geometry::box:
      return "box";
  }
  throw InternalError("unknown geometry");
}

std::vector<Geometry> geometries_of(const Element& element) {
  std::vector<Geometry> geometries{Geometry::general};
  if (element.has_affine) geometries.push_back(Geometry::affine);
  if (element.has_box) geometries.push_back(Geometry::box);
  return geometries;
}

NodeMatrix RestShape::jacobian(Dag& dag, const std::vector<NodeId>& positions, int g) const {
  if (geometry_ == Geometry::general) return gradients_.of(dag, positions, g);
  const int dim = element_.dim;
  NodeMatrix jacobian(dim, std::vector<NodeId>(dim, dag.number(NumberPool::zero)));
  for (int k = 0; k < dim; ++k) {
    for (int i = 0; i < dim; ++i) {
      if (geometry_ == Geometry::affine || i == k) {
        jacobian[i][k] = slope_along_edge(dag, positions, i, k);
      }
    }
  }
  return jacobian;
}

NodeMatrix RestShape::jacobian_of(Dag& dag, NodeMatrix inputs) const {
  if (geometry_ != Geometry::box) return inputs;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      if (i != k) inputs[i][k] = dag.number(NumberPool::zero);
    }
  }
  return inputs;
}

NodeMatrix RestShape::inverse(Dag& dag, const NodeMatrix& jacobian) const {
  return geometry_ == Geometry::box ? inverse_of_diagonal(dag, jacobian)
                                    : inverse_of(dag, jacobian);
}

/// Where the map is affine, d X_i / d xi_k everywhere: by the edge from node 0 along xi_k, its
/// component over the reference length. A box's Jacobian is diagonal.
NodeId RestShape::slope_along_edge(Dag& dag, const std::vector<NodeId>& positions, int i,
                                   int k) const {
  for (int b = 1; b < element_.num_nodes(); ++b) {
    bool is_edge = true;
    for (int j = 0; j < element_.dim; ++j) {
      const bool differs = !(element_.nodes[b][j] - element_.nodes[0][j]).is_zero();
      if (differs != (j == k)) is_edge = false;
    }
    if (!is_edge) continue;
    const ExactNumber length = exact_value(element_.nodes[b][k] - element_.nodes[0][k], {});
    return dag.scale(dag.numbers().intern(length.inverse()),
                     dag.subtract(positions[b * element_.dim + i], positions[i]));
  }
  throw InternalError("element " + element_.name + " has no edge along each coordinate");
}

}  // namespace elastogen::symgen
