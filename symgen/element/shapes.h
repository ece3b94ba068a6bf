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

/// Quadratic tetrahedron: the nodes of tet4, then the middles of the edges 01 12 20, 03 13 23, the
/// order of VTK_QUADRATIC_TETRA and of C3D10 (Abaqus, CalculiX).
/// Source: Zienkiewicz & Taylor, The Finite Element Method, 5th ed., vol. 1, section 8.12.
[[nodiscard]] Element make_tet10();

/// Quadratic hexahedron of the serendipity family: the nodes of hexa8, then the middles of the
/// edges 01 12 23 30, 45 56 67 74, 04 15 26 37, the order of VTK_QUADRATIC_HEXAHEDRON and of C3D20.
/// Source: Zienkiewicz & Taylor, The Finite Element Method, 5th ed., vol. 1, section 8.11.
[[nodiscard]] Element make_hexa20();

/// Linear prism along xi: the triangle's nodes at eta = 1, at mu = 1 and at the origin, first at
/// xi = -1, then at xi = 1.
[[nodiscard]] Element make_prism6();

/// Pyramid with rational functions: base (1,0) (0,1) (-1,0) (0,-1) at mu = 0, apex at mu = 1.
[[nodiscard]] Element make_pyramid5();

/// Appends the middle of every edge to the nodes, which so far are the corners.
void add_mid_edge_nodes(Element& element);

}  // namespace elastogen::symgen
