#include "symgen/mechanics/density_graph.h"

#include "symgen/dag/differentiate.h"
#include "symgen/dag/lower.h"

namespace elastogen::symgen {

DensityGraph build_density_graph(const Law& law, const EnergyDensity& energy) {
  DensityGraph graph;
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
  std::vector<Operand> terms;
  for (const GiNaC::ex& term : energy.terms) {
    terms.push_back({lower(dag, term, symbols), NumberPool::one});
  }
  graph.energy = dag.sum(std::move(terms));
  graph.stress = gradient(dag, graph.energy, graph.gradient);
  const NodeId one = dag.number(NumberPool::one);
  graph.tangent.resize(graph.stress.size());
  for (const NodeId input : graph.gradient) {
    const std::vector<NodeId> column = directional_derivative(dag, graph.stress, {{input, one}});
    for (std::size_t c = 0; c < column.size(); ++c) graph.tangent[c].push_back(column[c]);
  }
  return graph;
}

}  // namespace elastogen::symgen
