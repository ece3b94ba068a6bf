// The energy density W(H) at one point as a graph, with its stress and tangent.
#pragma once

#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/mechanics/energy.h"

namespace elastogen::symgen {

/// With d dimensions, component c = i * d + j stands for H_ij.
struct DensityGraph {
  Dag dag;
  std::vector<NodeId> parameters;            ///< in the law's order
  std::vector<NodeId> gradient;              ///< [c], inputs
  NodeId energy = 0;                         ///< sum of all terms
  std::vector<NodeId> stress;                ///< [c] = dW/dH_c, by reverse mode
  std::vector<std::vector<NodeId>> tangent;  ///< [c][e] = d stress[c] / dH_e, by forward mode
};

[[nodiscard]] DensityGraph build_density_graph(const Law& law, const EnergyDensity& energy);

}  // namespace elastogen::symgen
