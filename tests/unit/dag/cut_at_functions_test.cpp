#include "symgen/passes/cut_at_functions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "random_graph.h"
#include "symgen/emit/kernel_ast.h"

namespace elastogen::symgen {
namespace {

struct CutAtFunctions : ::testing::Test {
  Dag dag;
  NodeId p = dag.symbol("p", Stage::material);
  NodeId a = dag.symbol("a", Stage::state), b = dag.symbol("b", Stage::state),
         c = dag.symbol("c", Stage::state);
  // Two operations on inputs, worth storing.
  NodeId ab_c = dag.add(dag.multiply(a, b), c);

  [[nodiscard]] NodeId function(Function name, NodeId argument) {
    return dag.function(name, argument);
  }
  [[nodiscard]] std::optional<FunctionCut> cut(const std::vector<NodeId>& roots) const {
    std::vector<bool> inputs(dag.size(), false);
    for (const NodeId id : {a, b, c}) inputs[id] = true;
    return cut_at_functions(dag, roots, inputs);
  }
};

using Nodes = std::vector<NodeId>;

TEST_F(CutAtFunctions, LeavesWholeWhatWaitsForNothing) {
  EXPECT_FALSE(cut({dag.multiply(ab_c, a)}));
  // One operation of the processor, or one for all elements.
  EXPECT_FALSE(cut({dag.multiply(function(Function::negative_part, ab_c), a)}));
  EXPECT_FALSE(cut({dag.multiply(function(Function::exp, p), a)}));
  EXPECT_FALSE(cut({dag.multiply(dag.inverse(p), a)}));
}

TEST_F(CutAtFunctions, StoresArgumentsAndResults) {
  const NodeId log = function(Function::log1p, ab_c);
  const auto found = cut({dag.multiply(log, dag.multiply(ab_c, c)), ab_c});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->arguments, Nodes{ab_c});
  EXPECT_EQ(found->functions, Nodes{log});
  EXPECT_EQ(found->step_of_root, (std::vector<int>{2, 0}));
}

TEST_F(CutAtFunctions, TakesReciprocalsAndRootsForFunctions) {
  const NodeId third = dag.power(ab_c, dag.numbers().intern(ExactNumber(cln::cl_RA(1) / 3)));
  const NodeId inverse = dag.inverse(ab_c);
  const auto times = [&](NodeId power, NodeId other) {  // as group_stages leaves powers
    return dag.product_of_groups({{power, NumberPool::one}, {other, NumberPool::one}});
  };
  const auto found = cut({times(third, a), times(inverse, b)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->functions, (Nodes{std::min(third, inverse), std::max(third, inverse)}));
}

TEST_F(CutAtFunctions, ComputesAgainWhatIsOneOperationOnInputs) {
  const NodeId sum = dag.add(a, b);
  const NodeId log = function(Function::log, sum);
  const auto found = cut({dag.add(dag.multiply(log, sum), c)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->arguments, Nodes{});
  EXPECT_EQ(found->functions, Nodes{log});
}

TEST_F(CutAtFunctions, TakesWhatStandsBetweenTwoFunctionsWithThem) {
  const NodeId log = function(Function::log1p, ab_c);
  const NodeId between = dag.multiply(log, dag.add(ab_c, b));  // its other factor waits for none
  const NodeId exp = function(Function::exp, between);
  const auto found = cut({dag.multiply(exp, a)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->functions, Nodes{exp});  // nothing later reads the others
  EXPECT_TRUE(std::find(found->arguments.begin(), found->arguments.end(), ab_c) !=
              found->arguments.end());
}

int num_functions(const Fragment& fragment) {
  return static_cast<int>(fragment.operations.functions + fragment.operations.divisions);
}

TEST(Steps, ComputeEveryFunctionInTheSecondAndOnce) {
  int in_steps = 0;
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    const auto [graph, values] = make_random_graph(seed);
    Inputs inputs;
    for (const auto& [symbol, value] : values) {
      const Slot slot =
          graph.dag[symbol].stage <= Stage::material ? Slot::parameter : Slot::displacement;
      inputs[symbol] = {slot, static_cast<int>(inputs.size())};
    }
    std::vector<int> outputs(graph.roots.size());
    std::iota(outputs.begin(), outputs.end(), 0);
    outputs.back() = Output::margin;
    const Fragment whole =
        make_fragment(graph.dag, graph.roots, outputs, inputs, SumStyle::grouped);
    // Throws if a step reads what no step before it has stored.
    const auto steps = make_steps(graph.dag, graph.roots, outputs, inputs, SumStyle::grouped);
    if (!steps) continue;
    // What is one number for all elements may be computed in every step.
    if (std::any_of(whole.statements.begin(), whole.statements.end(),
                    [](const Statement& each) { return each.uniform && each.kind != Kind::sum; })) {
      continue;
    }
    ++in_steps;
    EXPECT_EQ(num_functions(steps->arguments), 0);
    EXPECT_EQ(num_functions(steps->rest), 0);
    EXPECT_EQ(num_functions(steps->functions), num_functions(whole));
    const auto num_margins = [](const Fragment& fragment) {
      return std::count_if(fragment.outputs.begin(), fragment.outputs.end(),
                           [](const Output& each) { return each.index == Output::margin; });
    };
    EXPECT_EQ(
        num_margins(steps->arguments) + num_margins(steps->functions) + num_margins(steps->rest),
        num_margins(whole));
  }
  EXPECT_GT(in_steps, 100);
}

}  // namespace
}  // namespace elastogen::symgen
