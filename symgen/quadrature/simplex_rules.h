// Tables: rules on the reference triangle and tetrahedron.
#pragma once

#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// Rule on the triangle x, y >= 0, x + y <= 1 (area 1/2):
///   1 point, the centroid, degree 1;
///   3 points, degree 2 (Hammer, Marlowe & Stroud, Numerical integration over simplexes and cones,
///   Math. Tables Aids Comput. 10, 1956);
///   7 points, degree 5 (Radon, Zur mechanischen Kubatur, Monatsh. Math. 52, 1948).
/// @throws InternalError  for another number of points
[[nodiscard]] Quadrature triangle_rule(int num_points);

/// Rule on the tetrahedron x, y, z >= 0, x + y + z <= 1 (volume 1/6): 1 point, degree 1;
/// 4 points, degree 2 (Hammer, Marlowe & Stroud, as above);
/// 15 points, degree 5 (Stroud, Approximate Calculation of Multiple Integrals, 1971, T3: 5-1).
/// @throws InternalError  for another number of points
[[nodiscard]] Quadrature tetrahedron_rule(int num_points);

}  // namespace elastogen::symgen
