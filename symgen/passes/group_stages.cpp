#include "symgen/passes/group_stages.h"

#include <array>

namespace elastogen::symgen {
namespace {

constexpr std::size_t num_stages = 5;
using ByStage = std::array<std::vector<Operand>, num_stages>;

/// base^(n/d) as operand of a product: whole power of base, of its reciprocal or of its root.
Operand whole_power(Dag& dag, const Operand& operand) {
  NumberPool& numbers = dag.numbers();
  const auto [numerator, denominator] = exponent_of(numbers, operand.factor);
  if (denominator == 1 && numerator > 0) return operand;
  // One primitive power per base and denominator: base^(1/d) or base^(-1/d).
  const long sign = numerator < 0 ? -1 : 1;
  Node primitive;
  primitive.kind = Kind::product;
  primitive.operands = {
      {operand.node, numbers.intern(ExactNumber(cln::cl_RA(sign) / cln::cl_I(denominator)))}};
  return {dag.intern(std::move(primitive)), numbers.intern(ExactNumber(sign * numerator))};
}

/// Nests the groups from the earliest stage to the latest.
NodeId nested(Dag& dag, Kind kind, const ByStage& groups, NumberId constant) {
  std::vector<Operand> operands;
  for (std::size_t s = 0; s < num_stages; ++s) {
    if (groups[s].empty()) continue;
    if (!operands.empty()) {
      const NodeId inner = kind == Kind::sum ? dag.sum(std::move(operands), constant)
                                             : dag.product_of_groups(std::move(operands));
      constant = NumberPool::zero;
      operands = {{inner, NumberPool::one}};
    }
    operands.insert(operands.end(), groups[s].begin(), groups[s].end());
  }
  return kind == Kind::sum ? dag.sum(std::move(operands), constant)
                           : dag.product_of_groups(std::move(operands));
}

}  // namespace

Graph group_stages(const Graph& graph) {
  Graph result{Dag(graph.dag.number_pool()), {}};
  Dag& dag = result.dag;
  result.roots = rebuild(graph.dag, graph.roots, [&](NodeId id, Node node) {
    if (node.kind == Kind::symbol) return dag.symbol(graph.dag.symbol_name(id), node.stage);
    if (node.kind == Kind::number || node.kind == Kind::function) {
      return dag.intern(std::move(node));
    }
    if (node.kind == Kind::product && node.operands.size() == 1) {
      // A lone primitive power (a reciprocal) is already in its final form.
      const Operand power = whole_power(dag, node.operands[0]);
      if (power.factor == NumberPool::one) return power.node;
    }
    ByStage groups;
    for (const Operand& operand : node.operands) {
      const Operand placed = node.kind == Kind::product ? whole_power(dag, operand) : operand;
      groups[static_cast<std::size_t>(dag[placed.node].stage)].push_back(placed);
    }
    return nested(dag, node.kind, groups, node.value);
  });
  return result;
}

}  // namespace elastogen::symgen
