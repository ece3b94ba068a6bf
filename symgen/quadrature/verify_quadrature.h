// Symbolic proofs that a rule is good enough for an element.
#pragma once

#include <vector>

#include "symgen/element/element.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// The highest total degree (up to `limit`) to which the rule integrates every monomial of the
/// reference coordinates exactly; -1 if not even constants.
[[nodiscard]] int polynomial_degree(const Element& element, const Quadrature& rule, int limit);

/// True if, for all positions of the nodes, the rule integrates the gradients of the shape
/// functions over the rest shape exactly: sum of w_g cof(J) grad Lambda_a is the integral. This is
/// what a patch test asks for.
///
/// With x = sum of Lambda_b x_b, component i of cof(J) grad Lambda_a is a sum over nodes b, c of
/// x_b x_c (positions' other two components) times det[grad Lambda_a, grad Lambda_b,
/// grad Lambda_c]. So it is enough, and necessary, that the determinants of all triples of nodes
/// are integrated exactly; no position need be chosen. In the plane the same holds of pairs.
[[nodiscard]] bool integrates_shape_gradients(const Element& element, const Quadrature& rule);

/// True if, for all positions of the nodes, the rule integrates Lambda_a det J exactly: nodal
/// volumes, by the same argument.
[[nodiscard]] bool integrates_nodal_volumes(const Element& element, const Quadrature& rule);

/// Rank of the stiffness matrix at rest of the energy density E:E (small strain) on an element with
/// the given rest positions [a][i], rational. The weights are positive, so it is the rank of the
/// strains at all points as functions of the nodal displacements. A rule is sound if it is
/// num_nodes * 3 - 6, in the plane num_nodes * 2 - 3: only rigid motions are free. Found in CLN
/// arithmetic of 60 digits.
[[nodiscard]] int stiffness_rank(const Element& element, const Quadrature& rule,
                                 const std::vector<std::vector<GiNaC::ex>>& positions);

}  // namespace elastogen::symgen
