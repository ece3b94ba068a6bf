// The map from an element's reference shape to its rest shape, at quadrature points.
#pragma once

#include <string>
#include <vector>

#include "symgen/element/element.h"
#include "symgen/mechanics/node_matrix.h"
#include "symgen/mechanics/reference_gradients.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// What is known of an element's rest shape: any; an affine image of the reference shape; or an
/// axis-aligned rectangular box.
enum class Geometry { general, affine, box };
[[nodiscard]] std::string geometry_name(Geometry geometry);

/// The variants that an element has, `general` first.
[[nodiscard]] std::vector<Geometry> geometries_of(const Element& element);

class RestShape {
 public:
  RestShape(const Element& element, const Quadrature& quadrature, Geometry geometry)
      : element_(element), geometry_(geometry), gradients_(element, quadrature) {}

  [[nodiscard]] const ReferenceGradients& gradients() const { return gradients_; }

  /// d X_i / d xi_k at point g, as [i][k].
  /// @param positions  [a * dim + i]
  [[nodiscard]] NodeMatrix jacobian(Dag& dag, const std::vector<NodeId>& positions, int g) const;

  /// The Jacobian at any one point from inputs d X_i / d xi_k, of which a box reads the diagonal.
  [[nodiscard]] NodeMatrix jacobian_of(Dag& dag, NodeMatrix inputs) const;

  /// d xi_k / d X_j, as [k][j].
  [[nodiscard]] NodeMatrix inverse(Dag& dag, const NodeMatrix& jacobian) const;

 private:
  [[nodiscard]] NodeId slope_along_edge(Dag& dag, const std::vector<NodeId>& positions, int i,
                                        int k) const;

  const Element& element_;
  Geometry geometry_;
  ReferenceGradients gradients_;
};

}  // namespace elastogen::symgen
