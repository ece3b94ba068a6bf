// Gradients of nodal fields in an element's reference coordinates, at quadrature points.
#pragma once

#include <string>
#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/element/element.h"
#include "symgen/mechanics/ginac_derivatives.h"
#include "symgen/mechanics/node_matrix.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// "U3.x": component i of a field at a node.
[[nodiscard]] std::string nodal_name(const std::string& field, int node, int i);
/// "dU.x/dxi0": its derivative in reference coordinates at a point.
[[nodiscard]] std::string gradient_name(const std::string& field, int i, int k);

/// "F2.5": entry of the flux at a point, an input of the integration.
[[nodiscard]] std::string flux_name(std::size_t point, std::size_t entry);

/// Inputs field_ai, as [a * dim + i].
[[nodiscard]] std::vector<NodeId> nodal_inputs(Dag& dag, const std::string& field,
                                               const Element& element, Stage stage);

/// Inputs d field_i / d xi_k, as [i][k].
[[nodiscard]] NodeMatrix gradient_inputs(Dag& dag, const std::string& field, int dim, Stage stage);

/// The linear map from nodal values to gradients. They are taken from differences of nodal values,
/// so that large translations cost no digits.
class ReferenceGradients {
 public:
  ReferenceGradients(const Element& element, const Quadrature& quadrature);

  /// [i][k] = sum_a field_ai d Lambda_a / d xi_k at point g.
  /// @param field  [a * dim + i]
  [[nodiscard]] NodeMatrix of(Dag& dag, const std::vector<NodeId>& field, int g) const;

  /// [reference coordinate]
  [[nodiscard]] const std::vector<std::vector<Difference>>& differences() const {
    return differences_;
  }
  /// [k][p] = d Lambda / d xi_k at point g of the node of differences()[k][p].
  [[nodiscard]] NodeMatrix coefficients(Dag& dag, int g) const;

 private:
  using ExactMatrix = std::vector<std::vector<ExactNumber>>;  // [node][reference coordinate]

  int dim_;
  std::vector<ExactMatrix> gradients_;  // [point]
  std::vector<std::vector<Difference>> differences_;
};

}  // namespace elastogen::symgen
