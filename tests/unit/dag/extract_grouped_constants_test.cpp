#include "symgen/passes/extract_grouped_constants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "random_graph.h"
#include "symgen/passes/cost.h"
#include "symgen/passes/group_stages.h"
#include "symgen/pipeline.h"

namespace elastogen::symgen {
namespace {

/// Total cost of storing exactly `stored`: prices of what is read plus time of what is recomputed;
/// infinite if nothing else can give a value.
double cost_of_storing(const Dag& dag, const std::vector<NodeId>& roots,
                       const std::vector<NodeId>& stored, const CutPrices& prices) {
  std::vector<bool> needed(dag.size(), false);
  const std::vector<bool> used = dag.reachable(roots);
  for (std::size_t i = 0; i < dag.size(); ++i) {
    const Node& node = dag[static_cast<NodeId>(i)];
    if (!used[i] || node.stage <= Stage::rest) continue;
    for (const Operand& operand : node.operands) needed[operand.node] = true;
  }
  for (const NodeId root : roots) needed[root] = true;
  double cost = 0;
  for (std::size_t i = dag.size(); i-- > 0;) {
    const NodeId id = static_cast<NodeId>(i);
    const Node& node = dag[id];
    if (!needed[i] || node.stage > Stage::rest || node.kind == Kind::number) continue;
    if (std::find(stored.begin(), stored.end(), id) != stored.end()) {
      cost += prices.stored;
    } else if (node.kind == Kind::symbol) {
      cost += node.stage == Stage::material ? 0 : prices.position;
    } else {
      cost += cost_of(dag, id).time();
      for (const Operand& operand : node.operands) needed[operand.node] = true;
    }
  }
  return cost;
}

TEST(MinimumCut, NoOtherChoiceIsCheaper) {
  int compared = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const RandomGraph random = make_random_graph(seed, 22);
    const Graph graph = group_stages(random.graph);
    std::vector<NodeId> candidates;
    const std::vector<bool> used = graph.dag.reachable(graph.roots);
    for (std::size_t i = 0; i < graph.dag.size(); ++i) {
      const Node& node = graph.dag[static_cast<NodeId>(i)];
      if (used[i] && node.stage <= Stage::rest && node.kind != Kind::number &&
          node.kind != Kind::symbol) {
        candidates.push_back(static_cast<NodeId>(i));
      }
    }
    if (candidates.empty() || candidates.size() > 12) continue;
    for (const CutPrices prices : {CutPrices{1.5, 1}, CutPrices{5, 3}, CutPrices{35, 12}}) {
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t bits = 0; bits < (std::size_t{1} << candidates.size()); ++bits) {
        std::vector<NodeId> stored;
        for (std::size_t k = 0; k < candidates.size(); ++k) {
          if ((bits >> k & 1) != 0) stored.push_back(candidates[k]);
        }
        best = std::min(best, cost_of_storing(graph.dag, graph.roots, stored, prices));
      }
      const std::vector<NodeId> chosen = minimum_cut(graph.dag, graph.roots, Stage::rest, prices);
      EXPECT_NEAR(cost_of_storing(graph.dag, graph.roots, chosen, prices), best, 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 30);
}

TEST(Algorithm6, GroupsConstantSiblingsAsInTheThesis) {
  // Thesis fig. 3.15-3.18: U0x (P1x + P1y) + U0y (P1x + P1y) p0 has two grouped constants.
  Graph graph;
  Dag& dag = graph.dag;
  const NodeId px = dag.symbol("P1x", Stage::rest), py = dag.symbol("P1y", Stage::rest);
  const NodeId p0 = dag.symbol("p0", Stage::material);
  const NodeId ux = dag.symbol("U0x", Stage::state), uy = dag.symbol("U0y", Stage::state);
  const NodeId sum = dag.add(px, py);
  graph.roots = {
      dag.add(dag.multiply(ux, sum),
              dag.product({{uy, NumberPool::one}, {sum, NumberPool::one}, {p0, NumberPool::one}}))};
  graph = group_stages(graph);
  EXPECT_EQ(algorithm6(graph.dag, graph.roots, Stage::rest).size(), 2U);
}

struct CountCase {
  const char* association;
  int algorithm6;  ///< general geometry
};

class ConstantCounts : public ::testing::TestWithParam<CountCase> {};

/// Tetra 11 as in the thesis (section 3.4.3): nine entries of the inverse Jacobian and two moduli
/// times the volume; eleven per Gauss point elsewhere.
TEST_P(ConstantCounts, ElevenPerPoint) {
  for (const char* law : {"hooke", "stvk", "neo_hookean"}) {
    const AssociationId id = AssociationId::parse(std::string(law) + GetParam().association);
    const Law read = read_law(std::string(ELASTOGEN_SOURCE_DIR) + "/laws/" + law + ".toml");
    const VariantReport report = generate_association(id, read, {}).variants[0];
    EXPECT_EQ(report.constants_algorithm6, GetParam().algorithm6) << id.text();
    EXPECT_LE(report.num_constants, report.constants_algorithm6) << id.text();
    GenerateOptions greedy;
    greedy.grouping = Grouping::algorithm6;
    EXPECT_EQ(generate_association(id, read, greedy).variants[0].num_constants,
              GetParam().algorithm6);
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, ConstantCounts,
                         ::testing::Values(CountCase{"-tet4-q1-none", 11},
                                           CountCase{"-hexa8-q8-none", 88},
                                           CountCase{"-prism6-q6-none", 66},
                                           CountCase{"-pyramid5-q5-none", 55}),
                         [](const auto& info) {
                           std::string name = info.param.association + 1;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(MinimumCut, DramProfileTakesJacobiansFromPositions) {
  const Law law = read_law(std::string(ELASTOGEN_SOURCE_DIR) + "/laws/stvk.toml");
  const AssociationId id = AssociationId::parse("stvk-hexa8-q8-none");
  GenerateOptions options;
  options.profile = "x86-cache";
  EXPECT_FALSE(generate_association(id, law, options).variants[0].reads_positions);
  options.profile = "x86-dram";
  const VariantReport streamed = generate_association(id, law, options).variants[0];
  EXPECT_TRUE(streamed.reads_positions);
  EXPECT_EQ(streamed.num_constants, 0);
}

}  // namespace
}  // namespace elastogen::symgen
