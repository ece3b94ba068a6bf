// One element's energies as a graph of positions, displacements and parameters, and what follows
// from them by differentiation.
#pragma once

#include <string>
#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/element/element.h"
#include "symgen/mechanics/derivation.h"
#include "symgen/mechanics/energy.h"
#include "symgen/mechanics/ginac_derivatives.h"
#include "symgen/mechanics/rest_shape.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// Energies of one element. With N nodes and d dimensions, node a and component i stand at a*d+i.
struct ElementGraph {
  Dag dag;
  std::vector<NodeId> positions;     ///< rest positions X [m], stage rest
  std::vector<NodeId> parameters;    ///< the law's, stage material
  std::vector<NodeId> displacement;  ///< U [m], stage state
  std::vector<NodeId> direction;     ///< V, stage direction
  /// energies[l][g]: law term l at quadrature point g, weight and det J included [J].
  std::vector<std::vector<NodeId>> energies;
  /// The same values as they are computed where no derivative is taken (EnergyDensity::values).
  std::vector<std::vector<NodeId>> energy_values;
  /// derivatives[l][g] of those energies as GiNaC took them; empty: the graph takes them.
  std::vector<std::vector<NodalDerivatives>> derivatives;
  std::vector<NodeId> nodal_volumes;  ///< integral of shape function a over the rest shape [m^d]
  /// Shares of the volume for a diagonal mass [m^d], all positive: the nodal volumes where these
  /// are, as in linear elements; else the volume in proportion to the integrals of the squares of
  /// the shape functions. Source: Hinton, Rock & Zienkiewicz, A note on mass lumping and related
  /// processes in the finite element method, Earthquake Eng. Struct. Dyn. 4 (1976) 245-249.
  std::vector<NodeId> lumped_volumes;
  std::vector<NodeId> determinants;  ///< det J at each quadrature point
};

/// Displacement gradients are taken from differences of nodal displacements, so that large
/// translations cost no digits.
/// Source: H = (sum_a U_a (x) grad_xi Lambda_a) J^-1, thesis eq. 3.22; W_E = sum_g w_g W(H_g) det
/// J, thesis eq. 3.40.
[[nodiscard]] ElementGraph build_element_graph(const Law& law, const EnergyDensity& energy,
                                               const Element& element, const Quadrature& quadrature,
                                               Geometry geometry,
                                               Derivation derivation = Derivation::dag);

/// The same element with what differs from law to law apart from what does not:
///   G_g,ik = sum_a U_ai d Lambda_a / d xi_k (point g)       a linear map of nodal values
///   W = sum_g w_g W(G_g, J_g)                               one graph for all points
///   f_ai = sum_gk w_g F_g,ik d Lambda_a / d xi_k (point g)  the map's transpose; F = -dW/dG
struct PointwiseGraph {
  /// One point: positions, displacement and direction are their gradients in reference coordinates,
  /// [i * dim + k]; energies [l][0] have no weight.
  ElementGraph point;
  /// Positions, displacement, direction and volumes of the element; no energies. Both graphs share
  /// their numbers.
  ElementGraph whole;
  bool is_affine = false;         ///< the Jacobian is the same at all points
  std::vector<NodeId> gradients;  ///< in `whole`: G, [(g * dim + i) * dim + k]
  std::vector<NodeId> jacobians;  ///< in `whole`: J, likewise, or [i * dim + k] if affine
  std::vector<NumberId> weights;  ///< w_g
};
[[nodiscard]] PointwiseGraph build_pointwise_graph(const Law& law, const EnergyDensity& energy,
                                                   const Element& element,
                                                   const Quadrature& quadrature, Geometry geometry);

/// Of inputs.
[[nodiscard]] std::vector<std::string> names_of(const Dag& dag, const std::vector<NodeId>& inputs);

/// Where an energy is defined: values that must be positive, one for each logarithm and each root
/// of something that depends on the displacement. Derivatives inherit the condition, not the
/// function (d log x = 1/x is finite at x < 0), so every operation has to check it.
[[nodiscard]] std::vector<NodeId> domain_of(Dag& dag, NodeId energy);

/// Nodal forces f = -dW/dU of a sum of energies, [a*d+i].
[[nodiscard]] std::vector<NodeId> forces_of(ElementGraph& graph, NodeId energy);

/// Product (df/dU) V of forces with the direction, [a*d+i].
[[nodiscard]] std::vector<NodeId> product_of(ElementGraph& graph,
                                             const std::vector<NodeId>& forces);

}  // namespace elastogen::symgen
