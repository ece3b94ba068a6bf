// Reference elements: nodes and shape functions, exact.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

namespace elastogen::symgen {

/// Reference shapes in the coordinates (xi, eta), and (xi, eta, mu):
///   triangle       xi, eta >= 0, xi + eta <= 1                               area 1/2
///   quadrilateral  [-1, 1]^2                                                 area 4
///   tetrahedron  xi, eta, mu >= 0, xi + eta + mu <= 1                        volume 1/6
///   hexahedron   [-1, 1]^3                                                   volume 8
///   prism        xi in [-1, 1] (the axis); eta, mu >= 0, eta + mu <= 1       volume 1
///   pyramid      base |xi| + |eta| <= 1 at mu = 0, apex (0, 0, 1)            volume 2/3
enum class ReferenceShape { triangle, quadrilateral, tetrahedron, hexahedron, prism, pyramid };

/// A reference element: shape, nodes, shape functions.
/// Source: X. Faure, Approche formelle pour la simulation interactive de modeles mixtes, thesis,
/// Lyon 2014, tables 3.1 to 3.3, after Dhatt & Touzot, Une presentation de la methode des
/// elements finis, 1984; the quadratic ones as in shapes.h.
struct Element {
  std::string name;  ///< "hexa8"
  ReferenceShape shape = ReferenceShape::tetrahedron;
  int dim = 3;                                ///< space dimensions, = reference coordinates
  std::vector<GiNaC::symbol> coordinates;     ///< reference coordinates xi, eta (, mu)
  std::vector<std::vector<GiNaC::ex>> nodes;  ///< [a][i] reference node coordinates, exact
  /// Quadratic elements: the corners at the ends of each edge whose middle is a node; those nodes
  /// stand after the corners, in this order. Linear elements: empty.
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<GiNaC::ex> shape_functions;  ///< [a] in `coordinates`, dimensionless
  bool affine = false;  ///< the map from reference to rest shape is always affine (tri3, tet4)
  /// Has the `affine` geometry variant: a simplex with straight edges, their nodes in the middle.
  bool has_affine = false;
  bool has_box = false;  ///< has the `box` geometry variant (axis-aligned rectangular rest shape)

  [[nodiscard]] int num_nodes() const { return static_cast<int>(nodes.size()); }
};

/// Names of all elements, in the order they are listed to users.
[[nodiscard]] const std::vector<std::string>& element_names();

/// @throws InputError  for an unknown name; says which exist and the nearest one
[[nodiscard]] const Element& find_element(const std::string& name);

/// The first `dim` of the coordinates xi, eta, mu, which all elements share.
[[nodiscard]] std::vector<GiNaC::symbol> reference_coordinates(int dim = 3);

/// d Lambda_a / d coordinate_i as [a][i], normalised (a quotient has one denominator).
[[nodiscard]] std::vector<std::vector<GiNaC::ex>> shape_gradients(const Element& element);

}  // namespace elastogen::symgen
