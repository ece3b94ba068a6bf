#include "symgen/passes/cost.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace elastogen::symgen {

OperationCount& OperationCount::operator+=(const OperationCount& other) {
  additions += other.additions;
  multiplications += other.multiplications;
  divisions += other.divisions;
  functions += other.functions;
  return *this;
}

OperationCount cost_of(const Dag& dag, NodeId id) {
  const Node& node = dag[id];
  const NumberPool& numbers = dag.numbers();
  OperationCount count;
  switch (node.kind) {
    case Kind::number:
    case Kind::symbol:
      break;
    case Kind::sum: {
      count.additions = static_cast<long>(node.operands.size()) - 1;
      if (node.value != NumberPool::zero) ++count.additions;
      std::vector<double> sizes;
      for (const Operand& operand : node.operands) {
        const double size = std::abs(numbers.value(operand.factor));
        if (size != 1.0) sizes.push_back(size);
      }
      std::sort(sizes.begin(), sizes.end());
      count.multiplications = std::unique(sizes.begin(), sizes.end()) - sizes.begin();
      break;
    }
    case Kind::product: {
      count.multiplications = static_cast<long>(node.operands.size()) - 1;
      for (const Operand& operand : node.operands) {
        const auto [numerator, denominator] = exponent_of(numbers, operand.factor);
        if (denominator != 1) {
          ++count.functions;
        } else if (numerator < 0) {
          ++count.divisions;
        }
        count.multiplications += std::labs(numerator) - 1;
      }
      break;
    }
    case Kind::function:
      count.functions = 1;
      break;
  }
  return count;
}

long flops_after_rest(const Graph& graph) {
  const std::vector<bool> needed = graph.dag.reachable(graph.roots);
  long flops = 0;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const NodeId id = static_cast<NodeId>(i);
    if (needed[i] && graph.dag[id].stage > Stage::rest) flops += cost_of(graph.dag, id).flops();
  }
  return flops;
}

}  // namespace elastogen::symgen
