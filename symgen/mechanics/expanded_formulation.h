// The thesis's own formulation: constants out of the energy first, then the energy as a polynomial
// in the nodal displacements, written out in full. It shows what not expanding saves, and checks
// the other formulations from a third side.
#pragma once

#include <span>
#include <vector>

#include "symgen/mechanics/element_graph.h"

namespace elastogen::symgen {

/// Grouped constants that algorithm 6 finds in energies of an element (thesis section 3.4.3), in
/// `graph.dag`: of the whole, or of one fragment.
struct EnergyConstants {
  Graph graph;                    ///< the energies with constant siblings grouped
  std::vector<NodeId> constants;  ///< ascending; parameters are not counted
};
[[nodiscard]] EnergyConstants energy_constants(const Dag& dag, std::span<const NodeId> energies);

/// Energy and derivatives of an element as polynomials, every monomial written out.
struct ExpandedFormulation {
  EnergyConstants definition;  ///< what is stored, from positions and parameters
  Dag dag;                     ///< over the stored constants, U and V
  /// Inputs of `dag`: constants[k] stands for definition.constants[k], then the law's parameters,
  /// displacement and direction as in ElementGraph. All but V count as known in every step, so that
  /// no product of constants is taken for a constant of its own.
  std::vector<NodeId> constants, parameters, displacement, direction;
  NodeId energy = 0;
  std::vector<NodeId> forces, product;  ///< [a * dim + i]
  long monomials = 0;                   ///< of the energy
};

/// Expands the energy of an affine element and differentiates the polynomial, by GiNaC.
/// Source: thesis, codes 4 and 5, algorithms 4 to 6.
/// @throws InternalError  unless the energy is a polynomial in the displacements
[[nodiscard]] ExpandedFormulation expand_formulation(const ElementGraph& element);

/// Operations of some values of the formulation, each monomial's products shared where equal.
[[nodiscard]] long flops_of(const ExpandedFormulation& formulation, std::span<const NodeId> values);

}  // namespace elastogen::symgen
