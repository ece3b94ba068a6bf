#include "symgen/passes/factor.h"

#include <algorithm>
#include <map>
#include <utility>

namespace elastogen::symgen {
namespace {

class Factoring {
 public:
  Factoring(Dag& dag) : dag_(dag), numbers_(dag.numbers()) {}

  /// sum of factor * node + constant, factored.
  NodeId factored_sum(std::vector<Operand> terms, NumberId constant) {
    while (terms.size() > 1) {
      const auto [common, uses] = most_shared_factor(terms);
      if (uses < 2) break;
      std::vector<Operand> inside, outside;
      NumberId inside_constant = NumberPool::zero;
      for (const Operand& term : terms) {
        if (term.node == common) {
          inside_constant = numbers_.add(inside_constant, term.factor);
        } else if (holds_factor(term.node, common)) {
          inside.push_back({without_factor(term.node, common), term.factor});
        } else {
          outside.push_back(term);
        }
      }
      const NodeId inner = factored_sum(merged(std::move(inside)), inside_constant);
      const NodeId product = dag_.product({{common, NumberPool::one}, {inner, NumberPool::one}});
      outside.push_back({product, NumberPool::one});
      outside = merged(std::move(outside));
      if (outside.size() >= terms.size()) break;
      terms = std::move(outside);
    }
    return dag_.sum(std::move(terms), constant);
  }

  /// Scaled nodes opened, equal nodes added up.
  std::vector<Operand> merged(std::vector<Operand> terms) {
    for (Operand& term : terms) {
      const Node& node = dag_[term.node];
      if (is_scaled(node)) {
        term = {node.operands[0].node, numbers_.multiply(term.factor, node.operands[0].factor)};
      }
    }
    std::map<NodeId, NumberId> total;
    for (const Operand& term : terms) {
      const auto [it, is_new] = total.try_emplace(term.node, term.factor);
      if (!is_new) it->second = numbers_.add(it->second, term.factor);
    }
    terms.clear();
    for (const auto& [node, factor] : total) {
      if (factor != NumberPool::zero) terms.push_back({node, factor});
    }
    return terms;
  }

 private:
  /// A factor that can be divided out: exponent a positive integer.
  bool divisible(NumberId exponent) const {
    const auto [numerator, denominator] = exponent_of(numbers_, exponent);
    return denominator == 1 && numerator >= 1;
  }

  bool is_open_product(NodeId id) const {
    return dag_[id].kind == Kind::product && dag_[id].stage > Stage::rest;
  }

  bool holds_factor(NodeId id, NodeId common) const {
    if (!is_open_product(id)) return false;
    for (const Operand& operand : dag_[id].operands) {
      if (operand.node == common && divisible(operand.factor)) return true;
    }
    return false;
  }

  NodeId without_factor(NodeId id, NodeId common) {
    std::vector<Operand> rest = dag_[id].operands;
    for (Operand& operand : rest) {
      if (operand.node == common) {
        operand.factor = numbers_.add(operand.factor, NumberPool::minus_one);
      }
    }
    return dag_.product(std::move(rest));
  }

  /// The factor of most terms; among equals the one known earliest, then the oldest.
  std::pair<NodeId, int> most_shared_factor(const std::vector<Operand>& terms) const {
    std::map<NodeId, int> uses;
    for (const Operand& term : terms) {
      if (is_open_product(term.node)) {
        for (const Operand& operand : dag_[term.node].operands) {
          if (divisible(operand.factor)) ++uses[operand.node];
        }
      } else if (dag_[term.node].kind != Kind::number) {
        ++uses[term.node];
      }
    }
    std::pair<NodeId, int> best{0, 0};
    for (const auto& [node, count] : uses) {
      if (count > best.second ||
          (count == best.second && dag_[node].stage < dag_[best.first].stage)) {
        best = {node, count};
      }
    }
    return best;
  }

  Dag& dag_;
  NumberPool& numbers_;
};

}  // namespace

Graph factor(const Graph& graph) {
  Graph result{Dag(graph.dag.number_pool()), {}};
  Dag& dag = result.dag;
  Factoring factoring(dag);
  result.roots = rebuild(graph.dag, graph.roots, [&](NodeId id, Node node) {
    if (node.kind == Kind::symbol) return dag.symbol(graph.dag.symbol_name(id), node.stage);
    if (node.kind == Kind::number || node.kind == Kind::function || node.stage <= Stage::rest) {
      return dag.intern(std::move(node));
    }
    if (node.kind == Kind::product) return dag.product(std::move(node.operands));
    return factoring.factored_sum(factoring.merged(std::move(node.operands)), node.value);
  });
  return result;
}

}  // namespace elastogen::symgen
