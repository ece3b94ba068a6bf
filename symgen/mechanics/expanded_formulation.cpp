#include "symgen/mechanics/expanded_formulation.h"

#include <unordered_map>
#include <utility>

#include "runtime/error.h"
#include "symgen/dag/lower.h"
#include "symgen/passes/cost.h"
#include "symgen/passes/extract_grouped_constants.h"
#include "symgen/passes/group_stages.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;

GiNaC::numeric to_ginac(const ExactNumber& number) { return GiNaC::numeric(number.rational()); }

/// The GiNaC expression of a polynomial node; `known` has the symbols, and grows.
const ex& raised(const Dag& dag, NodeId id, std::unordered_map<NodeId, ex>& known) {
  if (const auto found = known.find(id); found != known.end()) return found->second;
  const Node& node = dag[id];
  ex result;
  if (node.kind == Kind::number) {
    result = to_ginac(dag.numbers().exact(node.value));
  } else if (node.kind == Kind::sum) {
    result = to_ginac(dag.numbers().exact(node.value));
    for (const Operand& operand : node.operands) {
      result += to_ginac(dag.numbers().exact(operand.factor)) * raised(dag, operand.node, known);
    }
  } else if (node.kind == Kind::product) {
    result = 1;
    for (const Operand& operand : node.operands) {
      const auto [numerator, denominator] = exponent_of(dag.numbers(), operand.factor);
      if (denominator != 1 || numerator < 0) {
        throw InternalError("the energy to be expanded is no polynomial");
      }
      result *= GiNaC::pow(raised(dag, operand.node, known), static_cast<int>(numerator));
    }
  } else {
    throw InternalError("the energy to be expanded is no polynomial");
  }
  return known.emplace(id, result).first->second;
}

/// Symbols for some inputs of a graph, in GiNaC and in the new graph.
class InputSymbols {
 public:
  InputSymbols(Dag& target, std::unordered_map<NodeId, ex>& raised_inputs)
      : target_(target), raised_inputs_(raised_inputs) {}

  /// @param nodes  in the source; each becomes a symbol of the target, of stage `stage`
  std::vector<NodeId> add(std::span<const NodeId> nodes, const std::string& letter, Stage stage) {
    std::vector<NodeId> inputs;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::string name = letter + std::to_string(k);
      const GiNaC::symbol symbol(name);
      raised_inputs_[nodes[k]] = symbol;
      inputs.push_back(target_.symbol(name, stage));
      nodes_[symbol] = inputs.back();
      symbols_.push_back(symbol);
    }
    return inputs;
  }

  [[nodiscard]] const SymbolNodes& nodes() const { return nodes_; }
  /// The symbols added last.
  [[nodiscard]] std::vector<GiNaC::symbol> last(std::size_t count) const {
    return {symbols_.end() - static_cast<std::ptrdiff_t>(count), symbols_.end()};
  }

 private:
  Dag& target_;
  std::unordered_map<NodeId, ex>& raised_inputs_;
  SymbolNodes nodes_;
  std::vector<GiNaC::symbol> symbols_;
};

}  // namespace

EnergyConstants energy_constants(const Dag& dag, std::span<const NodeId> energies) {
  Graph graph{Dag(dag.number_pool()), {}};
  graph.roots = copy_into(graph.dag, dag, energies);
  graph = group_stages(graph);
  const std::vector<NodeId> constants = algorithm6(graph.dag, graph.roots, Stage::rest);
  return {std::move(graph), constants};
}

ExpandedFormulation expand_formulation(const ElementGraph& element) {
  ExpandedFormulation result;
  std::vector<NodeId> energies;
  for (const std::vector<NodeId>& points : element.energies) {
    energies.insert(energies.end(), points.begin(), points.end());
  }
  result.definition = energy_constants(element.dag, energies);
  result.dag = Dag(element.dag.number_pool());

  Dag& source = result.definition.graph.dag;
  const auto in_source = [&](const std::vector<NodeId>& nodes) {
    return copy_into(source, element.dag, nodes);
  };
  std::unordered_map<NodeId, ex> known;
  InputSymbols symbols(result.dag, known);
  result.parameters = symbols.add(in_source(element.parameters), "p", Stage::state);
  result.constants = symbols.add(result.definition.constants, "D", Stage::state);
  const std::size_t num_dofs = element.displacement.size();
  result.displacement = symbols.add(in_source(element.displacement), "U", Stage::state);
  const std::vector<GiNaC::symbol> displacement = symbols.last(num_dofs);
  result.direction = symbols.add(in_source(element.direction), "V", Stage::direction);
  const std::vector<GiNaC::symbol> direction = symbols.last(num_dofs);

  ex energy = 0;
  for (const NodeId root : result.definition.graph.roots) energy += raised(source, root, known);
  energy = energy.expand();
  result.monomials = static_cast<long>(GiNaC::is_a<GiNaC::add>(energy) ? energy.nops() : 1);

  std::vector<ex> forces, product;
  for (const GiNaC::symbol& component : displacement) {
    forces.push_back((-energy).expand().diff(component));
  }
  for (const ex& force : forces) {
    ex along = 0;
    for (std::size_t k = 0; k < num_dofs; ++k) {
      along += (force.diff(displacement[k]) * direction[k]).expand();
    }
    product.push_back(along);
  }
  result.energy = lower(result.dag, energy, symbols.nodes());
  result.forces = lower(result.dag, forces, symbols.nodes());
  result.product = lower(result.dag, product, symbols.nodes());
  return result;
}

long flops_of(const ExpandedFormulation& formulation, std::span<const NodeId> values) {
  const std::vector<bool> needed = formulation.dag.reachable(values);
  OperationCount total;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i]) total += cost_of(formulation.dag, static_cast<NodeId>(i));
  }
  return total.flops();
}

}  // namespace elastogen::symgen
