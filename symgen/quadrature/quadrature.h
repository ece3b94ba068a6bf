// Quadrature rules with exact points and weights.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symgen/element/element.h"

namespace elastogen::symgen {

/// An integration rule on a reference element: integral of f ~ sum of weight * f(point).
/// Coordinates and weights are exact (rationals and square roots of rationals, never nested).
struct Quadrature {
  std::string name;                            ///< "q8", or "exact"
  std::vector<std::vector<GiNaC::ex>> points;  ///< [g][i] reference coordinates
  std::vector<GiNaC::ex> weights;     ///< [g], positive, sum = volume of the reference element
  bool polynomial_laws_only = false;  ///< "exact": only for laws polynomial in H

  [[nodiscard]] int num_points() const { return static_cast<int>(weights.size()); }
};

/// Names of the rules offered for an element, coarsest first:
///   tri3      q1 (degree 1), q3 (degree 2), exact (analytic)
///   quad4     q4, q9: 2 and 3 Gauss points in each direction (degrees 3 and 5)
///   tet4      q1 (degree 1), q4 (degree 2), exact (analytic)
///   tet10     q4 (degree 2), q15 (degree 5)
///   hexa8     q8, q27: 2 and 3 Gauss points in each direction (degrees 3 and 5)
///   prism6    q6: 3-point triangle x 2 Gauss points (degree 2); q21: 7 x 3 (degree 5)
///   pyramid5  q5 (degree 2), q8: conical, 2 x 2 Gauss x 2 Gauss-Jacobi points (degree 3)
///   hexa20    q8: reduced integration, as C3D20R of Abaqus and CalculiX; q27: full
/// Each of a linear element integrates the gradients of the shape functions exactly on every
/// distorted element; so do q15 of tet10 and q27 of hexa20, while their q4 and q8 do it where the
/// edges are straight with their nodes in the middle. None leaves the stiffness a spurious
/// zero-energy mode, save hexa20-q8, which has six. Columns one element wide keep one for each
/// element, also where an end is held; beside other elements there is none (three by two, two by
/// two by two). Proofs: verify_quadrature.h, run by the tests.
/// @throws InputError  for an unknown element
[[nodiscard]] const std::vector<std::string>& quadrature_names(const std::string& element);

/// @throws InputError  for an unknown element or rule; says which the element has
[[nodiscard]] const Quadrature& find_quadrature(const std::string& element,
                                                const std::string& name);

/// The offered rule of the highest degree, used for nodal volumes: the integral of Lambda_a over
/// the rest shape is exact with it on every distorted element; of hexa20 where the edges are
/// straight, else the volume is exact but not its shares.
/// @throws InputError  for an unknown element
[[nodiscard]] const Quadrature& richest_quadrature(const std::string& element);

}  // namespace elastogen::symgen
