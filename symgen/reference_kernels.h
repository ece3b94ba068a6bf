// An element's operations as graphs for evaluation alone.
#pragma once

#include <vector>

#include "symgen/mechanics/element_graph.h"
#include "symgen/mechanics/stress_graph.h"

namespace elastogen::symgen {

/// What operations compute, in one graph of the element's inputs.
struct ReferenceKernels {
  Dag dag;
  std::vector<NodeId> positions, parameters, displacement, direction;  ///< as ElementGraph's
  NodeId energy = 0;
  std::vector<NodeId> forces, product;  ///< [a * dim + i]
  std::vector<NodeId> stress;           ///< [g * stress_numbers + k]
};

/// Everything as it comes from mechanics, without any pass: the reference.
[[nodiscard]] ReferenceKernels unoptimised_kernels(ElementGraph graph, const StressGraph& stress);

/// Energy, forces and product from the thesis's polynomials, every monomial written out. The thesis
/// has no stress.
[[nodiscard]] ReferenceKernels expanded_kernels(ElementGraph graph);

}  // namespace elastogen::symgen
