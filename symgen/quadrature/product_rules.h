// Rules from rules: tensor and conical products, and the one that analytic integration leaves.
#pragma once

#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// Rule on the product of two domains: coordinates of `first`, then of `second`; the points of
/// `first` vary fastest.
[[nodiscard]] Quadrature tensor_product(const Quadrature& first, const Quadrature& second);

/// `square`, a rule on [-1, 1]^2, turned by 45 degrees and scaled onto the pyramid's base
/// |u| + |v| <= 1.
[[nodiscard]] Quadrature turned_onto_diamond(const Quadrature& square);

/// Rule on the pyramid, (xi, eta, mu) = ((1 - z) u, (1 - z) v, z), from a rule for (u, v) on the
/// base and one for z on [0, 1] with the weight (1 - z)^2, the Jacobian of that map.
[[nodiscard]] Quadrature conical_product(const Quadrature& base, const Quadrature& height);

/// Analytic integration of a function that is constant over the element: one point, the centroid,
/// which stands for all of them, with the reference shape's volume, both integrated symbolically.
[[nodiscard]] Quadrature analytic_rule(const Element& element);

}  // namespace elastogen::symgen
