#include "symgen/dag/dag.h"

#include <gtest/gtest.h>

#include "symgen/dag/dot.h"
#include "symgen/dag/lower.h"
#include "symgen/mechanics/functions.h"

namespace elastogen::symgen {
namespace {

class DagTest : public ::testing::Test {
 protected:
  Dag dag;
  NodeId a = dag.symbol("a", Stage::state), b = dag.symbol("b", Stage::state);
  NodeId c = dag.symbol("c", Stage::rest), d = dag.symbol("d", Stage::rest);
  NumberId two = dag.numbers().intern(ExactNumber(2));
};

TEST_F(DagTest, OrderDoesNotMatter) {
  EXPECT_EQ(dag.add(a, b), dag.add(b, a));
  EXPECT_EQ(dag.multiply(a, b), dag.multiply(b, a));
  EXPECT_EQ(dag.multiply(a, dag.multiply(b, c)), dag.multiply(dag.multiply(c, a), b));
}

TEST_F(DagTest, DifferencesOfOppositeSignShareOneNode) {
  const NodeId forwards = dag.subtract(a, b), backwards = dag.subtract(b, a);
  ASSERT_NE(forwards, backwards);
  const Node& scaled = dag[backwards];
  ASSERT_EQ(scaled.operands.size(), 1U);
  EXPECT_EQ(scaled.operands[0].node, forwards);
  EXPECT_EQ(scaled.operands[0].factor, NumberPool::minus_one);
}

TEST_F(DagTest, MultiplesOfASumShareOneNode) {
  const NodeId sum = dag.add(a, b);
  EXPECT_EQ(dag.sum({{a, two}, {b, two}}), dag.scale(two, sum));
}

TEST_F(DagTest, TermsCancel) {
  EXPECT_TRUE(dag.is_zero(dag.subtract(a, a)));
  EXPECT_EQ(dag.multiply(a, dag.inverse(a)), dag.number(NumberPool::one));
  EXPECT_TRUE(dag.is_zero(dag.multiply(a, dag.number(NumberPool::zero))));
}

TEST_F(DagTest, ConstantsOfAProductAreOneFactor) {
  const NodeId product = dag.product(
      {{a, NumberPool::one}, {c, NumberPool::one}, {b, NumberPool::one}, {d, NumberPool::one}});
  EXPECT_EQ(dag[product].operands.size(), 3U);  // a, b, and c d
  EXPECT_EQ(product, dag.product({{a, NumberPool::one},
                                  {b, NumberPool::one},
                                  {dag.multiply(c, d), NumberPool::one}}));
}

TEST_F(DagTest, StagesAreTheLatestOfTheOperands) {
  EXPECT_EQ(dag[dag.multiply(c, d)].stage, Stage::rest);
  EXPECT_EQ(dag[dag.add(c, a)].stage, Stage::state);
  EXPECT_EQ(dag[dag.number(two)].stage, Stage::literal);
}

TEST_F(DagTest, CopyKeepsStructure) {
  const NodeId root = dag.multiply(dag.add(a, b), dag.inverse(dag.add(c, d)));
  Dag target(dag.number_pool());
  const std::vector<NodeId> first = copy_into(target, dag, std::vector<NodeId>{root});
  const std::size_t size = target.size();
  EXPECT_EQ(copy_into(target, dag, std::vector<NodeId>{root}), first);
  EXPECT_EQ(target.size(), size);
}

TEST(Lower, EqualExpressionsInAnyOrderAreOneNode) {
  const GiNaC::symbol x("x"), y("y");
  Dag dag;
  const SymbolNodes symbols = {{x, dag.symbol("x", Stage::state)},
                               {y, dag.symbol("y", Stage::state)}};
  const GiNaC::ex left = GiNaC::pow(x + y, 2) / GiNaC::sqrt(GiNaC::ex(3)) + log1p(x * y);
  const GiNaC::ex right = log1p(y * x) + GiNaC::pow(y + x, 2) * GiNaC::sqrt(GiNaC::ex(3)) / 3;
  EXPECT_EQ(lower(dag, left, symbols), lower(dag, right, symbols));
}

TEST(PrintDot, ShowsSymbolsStoredNodesAndRoots) {
  Dag dag;
  const NodeId c = dag.symbol("c", Stage::rest), u = dag.symbol("u", Stage::state);
  const NodeId square = dag.multiply(c, c);
  const std::vector<LabelledRoot> roots{{"forces[0]", dag.multiply(square, u)}};
  const std::string text = print_dot(dag, roots, std::vector<NodeId>{square}, "sample");
  EXPECT_NE(text.find("label=\"u\""), std::string::npos);
  EXPECT_NE(text.find("peripheries=2"), std::string::npos);
  EXPECT_NE(text.find("forces[0]"), std::string::npos);
  EXPECT_NE(text.find("label=\"^2\""), std::string::npos);
}

}  // namespace
}  // namespace elastogen::symgen
