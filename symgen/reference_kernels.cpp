#include "symgen/reference_kernels.h"

#include <unordered_map>
#include <utility>

#include "symgen/mechanics/expanded_formulation.h"

namespace elastogen::symgen {
namespace {

/// The graph goes to the kernels.
ReferenceKernels with_inputs_of(ElementGraph graph) {
  ReferenceKernels kernels;
  kernels.positions = std::move(graph.positions);
  kernels.parameters = std::move(graph.parameters);
  kernels.displacement = std::move(graph.displacement);
  kernels.direction = std::move(graph.direction);
  kernels.dag = std::move(graph.dag);
  return kernels;
}

}  // namespace

ReferenceKernels unoptimised_kernels(ElementGraph graph, const StressGraph& stress) {
  std::vector<Operand> summands;
  for (const std::vector<NodeId>& term : graph.energies) {
    for (const NodeId at_point : term) summands.push_back({at_point, NumberPool::one});
  }
  const NodeId energy = graph.dag.sum(std::move(summands));
  const std::vector<NodeId> forces = forces_of(graph, energy);
  const std::vector<NodeId> product = product_of(graph, forces);
  ReferenceKernels kernels = with_inputs_of(std::move(graph));
  kernels.energy = energy;
  kernels.forces = forces;
  kernels.product = product;
  for (const std::vector<NodeId>& point : stress.points) {
    const std::vector<NodeId> numbers = copy_into(kernels.dag, stress.dag, point);
    kernels.stress.insert(kernels.stress.end(), numbers.begin(), numbers.end());
  }
  return kernels;
}

ReferenceKernels expanded_kernels(ElementGraph graph) {
  const ExpandedFormulation expanded = expand_formulation(graph);
  const EnergyConstants& definition = expanded.definition;
  std::unordered_map<NodeId, NodeId> images;
  const auto put = [&](const std::vector<NodeId>& inputs, const std::vector<NodeId>& values) {
    for (std::size_t k = 0; k < inputs.size(); ++k) images[inputs[k]] = values[k];
  };
  put(expanded.parameters, graph.parameters);
  put(expanded.constants, copy_into(graph.dag, definition.graph.dag, definition.constants));
  put(expanded.displacement, graph.displacement);
  put(expanded.direction, graph.direction);
  ReferenceKernels kernels = with_inputs_of(std::move(graph));
  const auto substituted = [&](const std::vector<NodeId>& values) {
    return substitute_into(kernels.dag, expanded.dag, values, images);
  };
  kernels.energy = substituted({expanded.energy})[0];
  kernels.forces = substituted(expanded.forces);
  kernels.product = substituted(expanded.product);
  return kernels;
}

}  // namespace elastogen::symgen
