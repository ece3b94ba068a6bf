#include "symgen/mechanics/density_graph.h"

#include <utility>

#include "symgen/dag/differentiate.h"
#include "symgen/dag/lower.h"

namespace elastogen::symgen {
namespace {

NodeId sum_of(Dag& dag, const std::vector<GiNaC::ex>& terms, const SymbolNodes& symbols) {
  std::vector<Operand> summands;
  for (const GiNaC::ex& term : terms) {
    summands.push_back({lower(dag, term, symbols), NumberPool::one});
  }
  return dag.sum(std::move(summands));
}

/// dW/dH of each term with all definitions put in.
std::vector<NodeId> stress_by_ginac(Dag& dag, const EnergyDensity& energy,
                                    const SymbolNodes& symbols) {
  std::vector<GiNaC::ex> terms;
  for (std::size_t l = 0; l < energy.terms.size(); ++l) terms.push_back(flatten_term(energy, l));
  std::vector<NodeId> stress;
  for (const GiNaC::symbol& entry : energy.gradient) {
    std::vector<GiNaC::ex> derivatives;
    for (const GiNaC::ex& term : terms) derivatives.push_back(term.diff(entry));
    stress.push_back(sum_of(dag, derivatives, symbols));
  }
  return stress;
}

}  // namespace

DensityGraph build_stress_density(const Law& law, const EnergyDensity& energy,
                                  Derivation derivation, std::shared_ptr<NumberPool> numbers) {
  DensityGraph graph{Dag(std::move(numbers)), {}, {}, 0, 0, {}, {}};
  Dag& dag = graph.dag;
  SymbolNodes symbols;
  for (const Parameter& parameter : law.parameters) {
    graph.parameters.push_back(dag.symbol(parameter.name, Stage::material));
    symbols[parameter.symbol] = graph.parameters.back();
  }
  for (const GiNaC::symbol& entry : energy.gradient) {
    graph.gradient.push_back(dag.symbol(entry.get_name(), Stage::state));
    symbols[entry] = graph.gradient.back();
  }
  for (const Definition& definition : energy.definitions) {
    symbols[definition.symbol] = lower(dag, definition.value, symbols);
  }
  graph.energy = sum_of(dag, energy.terms, symbols);
  graph.value = sum_of(dag, energy.values, symbols);
  graph.stress = derivation == Derivation::ginac ? stress_by_ginac(dag, energy, symbols)
                                                 : gradient(dag, graph.energy, graph.gradient);
  return graph;
}

DensityGraph build_density_graph(const Law& law, const EnergyDensity& energy) {
  DensityGraph graph =
      build_stress_density(law, energy, Derivation::dag, std::make_shared<NumberPool>());
  Dag& dag = graph.dag;
  const NodeId one = dag.number(NumberPool::one);
  graph.tangent.resize(graph.stress.size());
  for (const NodeId input : graph.gradient) {
    const std::vector<NodeId> column = directional_derivative(dag, graph.stress, {{input, one}});
    for (std::size_t c = 0; c < column.size(); ++c) graph.tangent[c].push_back(column[c]);
  }
  return graph;
}

}  // namespace elastogen::symgen
