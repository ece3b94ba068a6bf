#include "symgen/build_stress.h"

#include <numeric>

#include "runtime/kernel_abi.h"
#include "symgen/passes/simplify.h"

namespace elastogen::symgen {
namespace {

/// Points one after the other, or each alone.
std::vector<std::vector<std::size_t>> point_parts(std::size_t num_points, const Split& split) {
  std::vector<std::size_t> all(num_points);
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (!split.gauss_point) return {all};
  std::vector<std::vector<std::size_t>> parts;
  for (const std::size_t g : all) parts.push_back({g});
  return parts;
}

Piece piece_of(Dag& target, const StressGraph& graph, const std::vector<std::size_t>& points,
               StageLog& log) {
  std::vector<NodeId> roots;
  std::vector<int> outputs;
  for (const std::size_t g : points) {
    for (std::size_t k = 0; k < graph.points[g].size(); ++k) {
      roots.push_back(graph.points[g][k]);
      outputs.push_back(static_cast<int>(g) * stress_numbers + static_cast<int>(k));
    }
  }
  for (const std::size_t g : points) {
    roots.insert(roots.end(), graph.margins[g].begin(), graph.margins[g].end());
  }
  Graph piece{Dag(graph.dag.number_pool()), {}};
  piece.roots = copy_into(piece.dag, graph.dag, roots);
  // Nothing of it is stored, so what is known at rest is part of the computation.
  piece = simplified(std::move(piece), Stage::material, log);
  roots = copy_into(target, piece.dag, piece.roots);
  const auto first_margin = roots.begin() + static_cast<std::ptrdiff_t>(outputs.size());
  return {{roots.begin(), first_margin}, std::move(outputs), {first_margin, roots.end()}};
}

Inputs inputs_of(Dag& dag, const StressGraph& graph) {
  Inputs inputs;
  const auto add = [&](const std::vector<NodeId>& nodes, Slot slot) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const NodeId id = dag.symbol(graph.dag.symbol_name(nodes[k]), graph.dag[nodes[k]].stage);
      inputs[id] = {slot, static_cast<int>(k)};
    }
  };
  add(graph.positions, Slot::position);
  add(graph.parameters, Slot::parameter);
  add(graph.displacement, Slot::displacement);
  add(graph.weight, Slot::direction);
  return inputs;
}

OperationKernels weights_of(Dag& dag, const std::vector<NumberId>& weights) {
  OperationKernels map{"point_weights", static_cast<int>(weights.size()), {}, {}};
  Piece& piece = map.pieces.emplace_back();
  for (const NumberId weight : weights) {
    piece.outputs.push_back(static_cast<int>(piece.roots.size()));
    piece.roots.push_back(dag.number(weight));
  }
  schedule(map, dag, {}, false);
  return map;
}

}  // namespace

void add_stress(VariantKernels& kernels, const StressGraph& graph, const Split& split,
                StageLog& log) {
  log.end("stress_graph", graph.dag.size());
  const auto num_points = static_cast<int>(graph.points.size());
  OperationKernels stress{"stress", num_points * stress_numbers, {}, {}};
  for (const std::vector<std::size_t>& points : point_parts(graph.points.size(), split)) {
    stress.pieces.push_back(piece_of(kernels.dag, graph, points, log));
  }
  schedule(stress, kernels.dag, inputs_of(kernels.dag, graph), false);
  kernels.operations.push_back(std::move(stress));
  if (kernels.loop) kernels.loop->point_weights = weights_of(kernels.dag, kernels.loop->weights);
  log.end("kernel_ast", kernels.dag.size());
}

}  // namespace elastogen::symgen
