#include "symgen/passes/balance_numbers.h"

#include <map>
#include <set>

#include "symgen/passes/cost.h"

namespace elastogen::symgen {
namespace {

/// Nodes with the numbers that they are multiplied by.
using Multiples = std::map<NodeId, NumberId>;

/// The graph with multiples instead of these nodes: each becomes 1/factor times its multiple.
Graph with_multiples(const Graph& graph, const Multiples& multiples) {
  Graph result{Dag(graph.dag.number_pool()), {}};
  Dag& dag = result.dag;
  result.roots = rebuild(graph.dag, graph.roots, [&](NodeId id, Node node) {
    NodeId image;
    switch (node.kind) {
      case Kind::symbol:
        image = dag.symbol(graph.dag.symbol_name(id), node.stage);
        break;
      case Kind::sum:
        image = dag.sum(std::move(node.operands), node.value);
        break;
      case Kind::product:
        image = is_multiple(dag, node) ? dag.intern(std::move(node))
                                       : dag.product_of_groups(std::move(node.operands));
        break;
      default:
        image = dag.intern(std::move(node));
    }
    const auto multiple = multiples.find(id);
    if (multiple == multiples.end()) return image;
    const NumberId inverse = dag.numbers().inverse(multiple->second);
    return dag.scale(inverse, dag.multiple(multiple->second, image));
  });
  return result;
}

/// Factors known at rest of what is not.
std::set<NodeId> candidates(const Graph& graph) {
  std::set<NodeId> result;
  const std::vector<bool> needed = graph.dag.reachable(graph.roots);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Node& node = graph.dag[static_cast<NodeId>(i)];
    if (!needed[i] || node.kind != Kind::product || node.stage <= Stage::rest) continue;
    for (const Operand& operand : node.operands) {
      const Node& factor = graph.dag[operand.node];
      if (factor.kind != Kind::number && factor.stage <= Stage::rest) result.insert(operand.node);
    }
  }
  return result;
}

/// Sizes of factors in sums of what is not known at rest, and their inverses.
std::set<NumberId> sizes(const Graph& graph) {
  NumberPool& numbers = graph.dag.numbers();
  std::set<NumberId> result;
  const std::vector<bool> needed = graph.dag.reachable(graph.roots);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Node& node = graph.dag[static_cast<NodeId>(i)];
    if (!needed[i] || node.kind != Kind::sum || node.stage <= Stage::rest || is_scaled(node)) {
      continue;
    }
    for (const Operand& operand : node.operands) {
      const NumberId size = numbers.size(operand.factor);
      if (size == NumberPool::one) continue;
      result.insert(size);
      result.insert(numbers.inverse(size));
    }
  }
  return result;
}

}  // namespace

Graph balance_numbers(const Graph& graph) {
  Multiples chosen;
  long least = flops_after_rest(graph);
  const std::set<NodeId> nodes = candidates(graph);
  const std::set<NumberId> factors = sizes(graph);
  constexpr std::size_t most_trials = 64;  // of one round; more are of many unlike numbers
  if (nodes.size() * factors.size() > most_trials) return graph;
  while (true) {
    Multiples best = chosen;
    for (const NodeId node : nodes) {
      if (chosen.contains(node)) continue;
      for (const NumberId factor : factors) {
        Multiples trial = chosen;
        trial[node] = factor;
        const long cost = flops_after_rest(with_multiples(graph, trial));
        if (cost + 1 < least) {  // one more to compute the multiple
          least = cost + 1;
          best = std::move(trial);
        }
      }
    }
    if (best.size() == chosen.size()) break;
    chosen = std::move(best);
  }
  return chosen.empty() ? graph : with_multiples(graph, chosen);
}

}  // namespace elastogen::symgen
