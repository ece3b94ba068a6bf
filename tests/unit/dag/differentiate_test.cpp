#include "symgen/dag/differentiate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_graph.h"
#include "symgen/dag/evaluate.h"
#include "symgen/dag/lower.h"
#include "symgen/law/law.h"
#include "symgen/mechanics/energy.h"

namespace elastogen::symgen {
namespace {

std::vector<double> evaluated(const Dag& dag, const std::vector<NodeId>& roots,
                              const std::map<NodeId, double>& values) {
  return evaluate<DoubleArithmetic>(dag, roots, DoubleArithmetic{},
                                    [&](NodeId id) { return values.at(id); });
}

TEST(Gradient, MatchesCentralDifferencesOnRandomGraphs) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomGraph random = make_random_graph(seed, 25);
    Dag& dag = random.graph.dag;
    const NodeId root = random.graph.roots[0];
    std::vector<NodeId> inputs;
    for (const auto& [id, value] : random.values) inputs.push_back(id);
    const std::vector<double> derivatives =
        evaluated(dag, gradient(dag, root, inputs), random.values);
    const double scale = std::abs(evaluated(dag, {root}, random.values)[0]);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      const double h = 1e-5;
      auto ahead = random.values, behind = random.values;
      ahead[inputs[k]] += h;
      behind[inputs[k]] -= h;
      const double difference =
          (evaluated(dag, {root}, ahead)[0] - evaluated(dag, {root}, behind)[0]) / (2 * h);
      EXPECT_NEAR(derivatives[k], difference,
                  1e-6 * (1 + scale + std::abs(difference) + std::abs(derivatives[k])));
    }
  }
}

TEST(DirectionalDerivative, IsGradientTimesDirection) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomGraph random = make_random_graph(seed, 40);
    Dag& dag = random.graph.dag;
    std::vector<NodeId> inputs;
    std::unordered_map<NodeId, NodeId> direction_of;
    auto values = random.values;
    int k = 0;
    for (const auto& [id, value] : random.values) {
      inputs.push_back(id);
      const NodeId direction = dag.symbol("v" + std::to_string(k), Stage::direction);
      direction_of[id] = direction;
      values[direction] = std::sin(1.0 + k++);
    }
    const NodeId root = random.graph.roots[0];
    const std::vector<double> by_input = evaluated(dag, gradient(dag, root, inputs), values);
    const double along = evaluated(
        dag, directional_derivative(dag, std::vector<NodeId>{root}, direction_of), values)[0];
    double expected = 0, size = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const double term = by_input[i] * values[direction_of[inputs[i]]];
      expected += term;
      size += std::abs(term);
    }
    EXPECT_NEAR(along, expected, 1e-11 * (size + 1));
  }
}

/// dW/dH taken by GiNaC from the flattened energy, and by the graph from the nested one.
TEST(Gradient, AgreesWithGinacOnEveryLaw) {
  for (const char* name : {"hooke", "stvk", "neo_hookean"}) {
    SCOPED_TRACE(name);
    const Law law = read_law(std::string(ELASTOGEN_SOURCE_DIR) + "/laws/" + name + ".toml");
    const EnergyDensity energy = energy_density(law, 3, {});
    Dag dag;
    SymbolNodes symbols;
    std::vector<NodeId> gradient_nodes;
    std::map<NodeId, double> values;
    for (std::size_t k = 0; k < 9; ++k) {
      gradient_nodes.push_back(dag.symbol("H" + std::to_string(k), Stage::state));
      symbols[energy.gradient[k]] = gradient_nodes[k];
      values[gradient_nodes[k]] = 0.1 * std::sin(3.0 * static_cast<double>(k) + 1.0);
    }
    for (const Parameter& parameter : law.parameters) {
      const NodeId node = dag.symbol(parameter.name, Stage::material);
      symbols[parameter.symbol] = node;
      values[node] = 1.5 + static_cast<double>(parameter.name.size());
    }
    const SymbolNodes inputs = symbols;
    for (const Definition& definition : energy.definitions) {
      symbols[definition.symbol] = lower(dag, definition.value, symbols);
    }
    for (std::size_t l = 0; l < energy.terms.size(); ++l) {
      const NodeId term = lower(dag, energy.terms[l], symbols);
      const std::vector<double> ours = evaluated(dag, gradient(dag, term, gradient_nodes), values);
      const GiNaC::ex flat = flatten_term(energy, l);
      for (std::size_t k = 0; k < 9; ++k) {
        const NodeId theirs = lower(dag, flat.diff(energy.gradient[k]), inputs);
        EXPECT_NEAR(ours[k], evaluated(dag, {theirs}, values)[0], 1e-13) << "H" << k;
      }
    }
  }
}

}  // namespace
}  // namespace elastogen::symgen
