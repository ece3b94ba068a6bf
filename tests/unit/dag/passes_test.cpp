// Every pass alone, on random graphs, against the graph before it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "random_graph.h"
#include "symgen/passes/absorb_factor.h"
#include "symgen/passes/balance_numbers.h"
#include "symgen/passes/cost.h"
#include "symgen/passes/factor.h"
#include "symgen/passes/group_stages.h"
#include "symgen/passes/share_pairs.h"

namespace elastogen::symgen {
namespace {

using Pass = std::function<Graph(const Graph&)>;

struct NamedPass {
  const char* name;
  Pass pass;
};

std::ostream& operator<<(std::ostream& out, const NamedPass& named) { return out << named.name; }

class PassTest : public ::testing::TestWithParam<NamedPass> {};

TEST_P(PassTest, PreservesTheValueOfEveryRoot) {
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const RandomGraph random = make_random_graph(seed);
    const std::vector<double> before = values_of(random.graph, random);
    const std::vector<double> after = values_of(GetParam().pass(random.graph), random);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t k = 0; k < before.size(); ++k) {
      EXPECT_NEAR(after[k], before[k], 1e-7 * (1 + std::abs(before[k])));
    }
  }
}

TEST_P(PassTest, IsDeterministic) {
  const RandomGraph random = make_random_graph(11);
  const Graph first = GetParam().pass(random.graph), second = GetParam().pass(random.graph);
  ASSERT_EQ(first.dag.size(), second.dag.size());
  EXPECT_EQ(first.roots, second.roots);
  for (NodeId id = 0; id < first.dag.size(); ++id) {
    EXPECT_EQ(first.dag[id].operands, second.dag[id].operands);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Passes, PassTest,
    ::testing::Values(NamedPass{"factor", factor}, NamedPass{"group_stages", group_stages},
                      NamedPass{"share_pairs",
                                [](const Graph& g) { return share_pairs(g, Stage::literal); }},
                      NamedPass{"balance_numbers", balance_numbers},
                      NamedPass{"all",
                                [](const Graph& g) {
                                  return balance_numbers(
                                      share_pairs(group_stages(factor(g)), Stage::state));
                                }}),
    [](const auto& info) { return info.param.name; });

long total_flops(const Graph& graph) {
  const std::vector<bool> needed = graph.dag.reachable(graph.roots);
  long flops = 0;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i]) flops += cost_of(graph.dag, static_cast<NodeId>(i)).flops();
  }
  return flops;
}

TEST(Factor, TakesOutTheCommonFactor) {
  Graph graph;
  Dag& dag = graph.dag;
  const NodeId x = dag.symbol("x", Stage::state), y = dag.symbol("y", Stage::state),
               z = dag.symbol("z", Stage::state), w = dag.symbol("w", Stage::state);
  // x y + x z + x w: 5 operations; x (y + z + w): 3
  graph.roots = {dag.sum({{dag.multiply(x, y), NumberPool::one},
                          {dag.multiply(x, z), NumberPool::one},
                          {dag.multiply(x, w), NumberPool::one}})};
  EXPECT_EQ(total_flops(graph), 5);
  EXPECT_EQ(total_flops(factor(graph)), 3);
}

struct Numbers : ::testing::Test {
  Graph graph;
  Dag& dag = graph.dag;
  NodeId x = dag.symbol("x", Stage::state), y = dag.symbol("y", Stage::state);
  NodeId p = dag.symbol("p", Stage::material), volume = dag.symbol("volume", Stage::rest);
  NodeId stiffness = dag.multiply(p, volume);

  [[nodiscard]] NumberId n(long numerator, long denominator = 1) const {
    return dag.numbers().intern(ExactNumber(cln::cl_RA(numerator) / cln::cl_I(denominator)));
  }
  /// factor * constant * value, the constant a factor of its own.
  [[nodiscard]] NodeId times(NumberId factor, NodeId constant, NodeId value) {
    const NodeId product =
        dag.product_of_groups({{constant, NumberPool::one}, {value, NumberPool::one}});
    return dag.scale(factor, product);
  }
};

TEST_F(Numbers, GoIntoFactorsKnownAtRestWhereThatSaves) {
  // 2 k x + y, 2 k y + x, (x + 2 k (x + y)) / 2: with 2 k only the last number is left.
  graph.roots = {dag.add(times(n(2), stiffness, x), y), dag.add(times(n(2), stiffness, y), x),
                 dag.add(dag.scale(n(1, 2), x), times(n(1), stiffness, dag.add(x, y)))};
  const long before = total_flops(graph);
  const Graph balanced = balance_numbers(graph);
  EXPECT_EQ(total_flops(balanced), before - 3 + 1);
  // What passes do after it leaves the multiple whole.
  EXPECT_EQ(total_flops(share_pairs(balanced, Stage::material)), before - 3 + 1);
}

TEST_F(Numbers, StayWhereTheyAreWhereNothingIsSaved) {
  graph.roots = {dag.add(times(n(2), stiffness, x), y), dag.add(times(n(1), stiffness, y), x)};
  EXPECT_EQ(total_flops(balance_numbers(graph)), total_flops(graph));
}

TEST_F(Numbers, InFrontOfAllResultsGoIntoTheConstantThatAllAreProportionalTo) {
  const NodeId margin = dag.sum({{x, n(1)}}, n(1));
  const std::vector<NodeId> nodal = {
      times(n(1, 6), stiffness, x),
      times(n(-1, 6), stiffness, dag.add(x, times(n(3), p, dag.multiply(x, y))))};
  const std::vector<NodeId> energy = {times(n(1, 12), stiffness, dag.multiply(x, x))};
  const std::vector<NodeId> constants = {dag.symbol("gradient", Stage::rest), volume};
  const auto found = absorb_factor(dag, nodal, energy, {{margin}}, constants);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->constant, 1U);
  EXPECT_EQ(found->factor, n(1, 6));

  // Not: the energy has a part that does not depend on it, the domain does, factors differ.
  EXPECT_FALSE(absorb_factor(dag, nodal, {{dag.add(energy[0], x)}}, {{margin}}, constants));
  EXPECT_FALSE(absorb_factor(dag, nodal, energy, {{dag.add(margin, volume)}}, constants));
  EXPECT_FALSE(absorb_factor(dag, {{nodal[0], times(n(1, 3), stiffness, y)}}, energy, {{margin}},
                             constants));
  EXPECT_FALSE(absorb_factor(dag, {{times(n(1, 6), stiffness, dag.multiply(volume, x))}}, energy,
                             {{margin}}, constants));
}

TEST(SharePairs, SharesPairsOfEqualRatio) {
  Graph graph;
  Dag& dag = graph.dag;
  const auto n = [&](long value) { return dag.numbers().intern(ExactNumber(value)); };
  const NodeId x = dag.symbol("x", Stage::state), y = dag.symbol("y", Stage::state),
               z = dag.symbol("z", Stage::state), w = dag.symbol("w", Stage::state);
  // x + 2 y + z and 3 x + 6 y + w hold x + 2 y twice
  graph.roots = {dag.sum({{x, n(1)}, {y, n(2)}, {z, n(1)}}),
                 dag.sum({{x, n(3)}, {y, n(6)}, {w, n(1)}})};
  const Graph shared = share_pairs(graph, Stage::state);
  int pairs = 0;
  for (NodeId id = 0; id < shared.dag.size(); ++id) {
    const Node& node = shared.dag[id];
    if (node.kind != Kind::sum || node.operands.size() != 2) continue;
    const bool has_ratio = node.operands[0].factor == n(1) && node.operands[1].factor == n(2);
    if (has_ratio && shared.dag.symbol_name(node.operands[0].node) == "x" &&
        shared.dag.symbol_name(node.operands[1].node) == "y") {
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, 1);
}

TEST(GroupStages, WhatIsKnownEarlierIsOneNode) {
  Graph graph;
  Dag& dag = graph.dag;
  const NodeId c = dag.symbol("c", Stage::rest), d = dag.symbol("d", Stage::rest);
  const NodeId u = dag.symbol("u", Stage::state), v = dag.symbol("v", Stage::direction);
  graph.roots = {dag.sum(
      {{c, NumberPool::one}, {u, NumberPool::one}, {v, NumberPool::one}, {d, NumberPool::one}})};
  const Graph grouped = group_stages(graph);
  const Node& root = grouped.dag[grouped.roots[0]];
  ASSERT_EQ(root.operands.size(), 2U);  // v, and the state
  for (const Operand& operand : root.operands) {
    const Node& node = grouped.dag[operand.node];
    if (node.stage != Stage::state) continue;
    EXPECT_EQ(node.operands.size(), 2U);  // u, and c + d
  }
}

TEST(GroupStages, OneReciprocalPerBase) {
  Graph graph;
  Dag& dag = graph.dag;
  const NodeId u = dag.symbol("u", Stage::state), v = dag.symbol("v", Stage::state);
  const auto n = [&](long value) { return dag.numbers().intern(ExactNumber(value)); };
  graph.roots = {dag.product({{u, n(-2)}, {v, n(1)}}), dag.product({{u, n(-1)}, {v, n(2)}})};
  const Graph grouped = group_stages(graph);
  OperationCount count;
  const std::vector<bool> needed = grouped.dag.reachable(grouped.roots);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i]) count += cost_of(grouped.dag, static_cast<NodeId>(i));
  }
  EXPECT_EQ(count.divisions, 1);
}

}  // namespace
}  // namespace elastogen::symgen
