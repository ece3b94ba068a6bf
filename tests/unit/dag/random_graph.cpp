#include "random_graph.h"

#include <string>

#include "symgen/dag/evaluate.h"

namespace elastogen::symgen {

RandomGraph make_random_graph(std::uint32_t seed, int num_nodes) {
  std::mt19937 generator(seed);
  return make_graph(
      [&](std::size_t bound) {
        return std::uniform_int_distribution<std::size_t>(0, bound - 1)(generator);
      },
      num_nodes);
}

RandomGraph make_graph(const std::function<std::size_t(std::size_t)>& below, int num_nodes) {
  RandomGraph result;
  Dag& dag = result.graph.dag;
  std::vector<NodeId> nodes;
  for (const Stage stage : {Stage::material, Stage::rest, Stage::state, Stage::direction}) {
    for (int k = 0; k < 3; ++k) {
      const std::string name = "s" + std::to_string(static_cast<int>(stage)) + std::to_string(k);
      nodes.push_back(dag.symbol(name, stage));
      result.values[nodes.back()] = 0.5 + static_cast<double>(below(1024)) / 1024;
    }
  }
  const std::vector<ExactNumber> factors = {ExactNumber(1),
                                            ExactNumber(1),
                                            ExactNumber(-1),
                                            ExactNumber(2),
                                            ExactNumber(-3),
                                            ExactNumber(cln::cl_RA(1) / 3),
                                            ExactNumber::square_root(3)};
  for (int k = 0; k < num_nodes; ++k) {
    const std::size_t choice = below(8);
    std::vector<Operand> operands;
    const std::size_t count = 2 + below(4);
    for (std::size_t i = 0; i < count; ++i) {
      const NodeId node = nodes[below(nodes.size())];
      const NumberId factor = dag.numbers().intern(factors[below(factors.size())]);
      operands.push_back({node, choice < 4 ? factor : NumberPool::one});
    }
    if (choice < 4) {
      nodes.push_back(dag.sum(operands, dag.numbers().intern(factors[below(factors.size())])));
    } else if (choice < 6) {
      operands.resize(2);
      nodes.push_back(dag.product(operands));
    } else {
      // 1 + x^2 is positive whatever x is: divide by it, or take its logarithm.
      const NodeId square = dag.multiply(operands[0].node, operands[0].node);
      const NodeId positive = dag.sum({{square, NumberPool::one}}, NumberPool::one);
      nodes.push_back(choice == 6 ? dag.multiply(operands[1].node, dag.inverse(positive))
                                  : dag.function(Function::log1p, square));
    }
  }
  for (int k = 0; k < 5; ++k) result.graph.roots.push_back(nodes[nodes.size() - 1 - below(10)]);
  return result;
}

std::vector<double> values_of(const Graph& graph, const RandomGraph& reference) {
  std::map<std::string, double> by_name;
  for (const auto& [id, value] : reference.values) {
    by_name[reference.graph.dag.symbol_name(id)] = value;
  }
  return evaluate<DoubleArithmetic>(graph.dag, graph.roots, DoubleArithmetic{}, [&](NodeId id) {
    return by_name.at(graph.dag.symbol_name(id));
  });
}

}  // namespace elastogen::symgen
