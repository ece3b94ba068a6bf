// Shape functions at the points of a quadrature, as numbers.
#pragma once

#include <vector>

#include "symgen/element/element.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// With n nodes and d dimensions, exact values rounded once.
struct ReferencePoints {
  std::vector<double> weights;    ///< [g], of the reference volume
  std::vector<double> shapes;     ///< [g * n + a]: Lambda_a
  std::vector<double> gradients;  ///< [(g * n + a) * d + k]: d Lambda_a / d xi_k
};

[[nodiscard]] ReferencePoints reference_points(const Element& element,
                                               const Quadrature& quadrature);

}  // namespace elastogen::symgen
