#include "symgen/dag/differentiate.h"

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

/// d node / d operand_k for a product or function node; the operand's own factor is included.
NodeId partial_derivative(Dag& dag, const Node& node, std::size_t k) {
  NumberPool& numbers = dag.numbers();
  const NodeId x = node.operands[k].node;
  if (node.kind == Kind::product) {
    const NumberId exponent = node.operands[k].factor;
    std::vector<Operand> rest = node.operands;
    rest[k].factor = numbers.add(exponent, NumberPool::minus_one);
    return dag.scale(exponent, dag.product(std::move(rest)));
  }
  switch (node.function) {
    case Function::log:
      return dag.inverse(x);
    case Function::log1p:
      return dag.inverse(dag.sum({{x, NumberPool::one}}, NumberPool::one));
    case Function::log1p_remainder:  // d/dx (x - log(1 + x)) = x / (1 + x)
      return dag.multiply(x, dag.inverse(dag.sum({{x, NumberPool::one}}, NumberPool::one)));
    case Function::exp:
      return dag.function(Function::exp, x);
    case Function::expm1_remainder:  // exp(y) - 1, by what the energy has computed already
      return dag.add(x, dag.function(Function::expm1_remainder, x));
    case Function::negative_part:  // of energies that nobody differentiates
    case Function::none:
      break;
  }
  throw InternalError("no derivative for this kind of node");
}

}  // namespace

std::vector<NodeId> gradient(Dag& dag, NodeId root, std::span<const NodeId> inputs) {
  const std::size_t count = static_cast<std::size_t>(root) + 1;
  std::vector<bool> depends(count, false);
  for (const NodeId input : inputs) {
    if (input < count) depends[input] = true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (const Operand& operand : dag[static_cast<NodeId>(i)].operands) {
      if (depends[operand.node]) depends[i] = true;
    }
  }
  std::vector<std::vector<Operand>> contributions(count);
  std::vector<NodeId> adjoint(count, dag.number(NumberPool::zero));
  contributions[root] = {{dag.number(NumberPool::one), NumberPool::one}};
  for (std::size_t i = count; i-- > 0;) {
    if (!depends[i] || contributions[i].empty()) continue;
    adjoint[i] = dag.sum(std::move(contributions[i]));
    const Node node = dag[static_cast<NodeId>(i)];  // a copy: the graph grows below
    for (std::size_t k = 0; k < node.operands.size(); ++k) {
      const Operand& operand = node.operands[k];
      if (!depends[operand.node]) continue;
      if (node.kind == Kind::sum) {
        contributions[operand.node].push_back({adjoint[i], operand.factor});
      } else {
        const NodeId term = dag.multiply(adjoint[i], partial_derivative(dag, node, k));
        contributions[operand.node].push_back({term, NumberPool::one});
      }
    }
  }
  std::vector<NodeId> result;
  for (const NodeId input : inputs) {
    result.push_back(input < count ? adjoint[input] : dag.number(NumberPool::zero));
  }
  return result;
}

std::vector<NodeId> directional_derivative(
    Dag& dag, std::span<const NodeId> roots,
    const std::unordered_map<NodeId, NodeId>& direction_of_input) {
  const std::vector<bool> needed = dag.reachable(roots);
  const std::size_t count = needed.size();
  const NodeId zero = dag.number(NumberPool::zero);
  std::vector<NodeId> tangent(count, zero);
  for (std::size_t i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    const NodeId id = static_cast<NodeId>(i);
    if (const auto input = direction_of_input.find(id); input != direction_of_input.end()) {
      tangent[i] = input->second;
      continue;
    }
    const Node node = dag[id];  // a copy: the graph grows below
    std::vector<Operand> terms;
    for (std::size_t k = 0; k < node.operands.size(); ++k) {
      const NodeId inner = tangent[node.operands[k].node];
      if (dag.is_zero(inner)) continue;
      if (node.kind == Kind::sum) {
        terms.push_back({inner, node.operands[k].factor});
      } else {
        terms.push_back({dag.multiply(inner, partial_derivative(dag, node, k)), NumberPool::one});
      }
    }
    tangent[i] = dag.sum(std::move(terms));
  }
  std::vector<NodeId> result;
  for (const NodeId root : roots) result.push_back(tangent[root]);
  return result;
}

}  // namespace elastogen::symgen
