// The energy density W(H) at one point as a graph, with its stress and tangent.
#pragma once

#include <memory>
#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/mechanics/derivation.h"
#include "symgen/mechanics/energy.h"

namespace elastogen::symgen {

/// With d dimensions, component c = i * d + j stands for H_ij.
struct DensityGraph {
  Dag dag;
  std::vector<NodeId> parameters;            ///< in the law's order
  std::vector<NodeId> gradient;              ///< [c], inputs
  NodeId energy = 0;                         ///< sum of all terms
  NodeId value = 0;                          ///< the same from EnergyDensity::values
  std::vector<NodeId> stress;                ///< [c] = dW/dH_c
  std::vector<std::vector<NodeId>> tangent;  ///< [c][e] = d stress[c] / dH_e, by forward mode
};

/// Everything, the stress by reverse mode.
[[nodiscard]] DensityGraph build_density_graph(const Law& law, const EnergyDensity& energy);

/// Everything but the tangent.
/// @param derivation  who takes the stress: reverse mode on the graph, or GiNaC
/// @param numbers     of the graph
[[nodiscard]] DensityGraph build_stress_density(const Law& law, const EnergyDensity& energy,
                                                Derivation derivation,
                                                std::shared_ptr<NumberPool> numbers);

}  // namespace elastogen::symgen
