// The elements, one source file each; `element.cpp` lists them.
#pragma once

#include "symgen/element/element.h"

namespace elastogen::symgen {

/// Linear triangle: nodes at the origin and at 1 on xi, eta.
[[nodiscard]] Element make_tri3();

/// Bilinear quadrilateral: counter-clockwise from (-1, -1).
[[nodiscard]] Element make_quad4();

/// Linear tetrahedron: nodes at the origin and at 1 on xi, eta, mu.
[[nodiscard]] Element make_tet4();

/// Trilinear hexahedron: face mu = -1 counter-clockwise from (-1, -1), then face mu = 1.
[[nodiscard]] Element make_hexa8();

/// Linear prism along xi: the triangle's nodes at eta = 1, at mu = 1 and at the origin, first at
/// xi = -1, then at xi = 1.
[[nodiscard]] Element make_prism6();

/// Pyramid with rational functions: base (1,0) (0,1) (-1,0) (0,-1) at mu = 0, apex at mu = 1.
[[nodiscard]] Element make_pyramid5();

}  // namespace elastogen::symgen
