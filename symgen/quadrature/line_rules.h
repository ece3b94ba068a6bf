// Tables: rules on intervals.
#pragma once

#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// Gauss-Legendre rule on [-1, 1], exact to degree 2 num_points - 1; num_points in {1, 2, 3}.
/// Source: Abramowitz & Stegun, Handbook of Mathematical Functions, table 25.4.
/// @throws InternalError  for another number of points
[[nodiscard]] Quadrature gauss_legendre(int num_points);

/// Two-point Gauss-Jacobi rule on [0, 1] for the weight (1 - z)^2, exact to degree 3: what is left
/// of a pyramid's integral along its axis. The points are the roots of z^2 - 2/3 z + 1/15, which
/// is orthogonal to 1 and z (moments 1/3, 1/12, 1/30, 1/60).
[[nodiscard]] Quadrature gauss_jacobi_height();

}  // namespace elastogen::symgen
