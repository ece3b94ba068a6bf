#include "symgen/emit/kernel_ast.h"

#include <gtest/gtest.h>

#include "symgen/build_kernels.h"
#include "symgen/emit/source_writer.h"

namespace elastogen::symgen {
namespace {

/// out = factor * u * c[index] + u
Fragment sample(Dag& dag, long factor, int constant) {
  const NodeId u = dag.symbol("u", Stage::state);
  const NodeId c = dag.symbol("c" + std::to_string(constant), Stage::rest);
  const NodeId root = dag.sum(
      {{u, NumberPool::one}, {dag.multiply(u, c), dag.numbers().intern(ExactNumber(factor))}});
  const Inputs inputs{{u, {Slot::displacement, 0}}, {c, {Slot::constant, constant}}};
  return make_fragment(dag, std::vector<NodeId>{root}, std::vector<int>{constant}, inputs,
                       SumStyle::plain);
}

TEST(GroupFragments, EqualUpToNumbersAndConstantsIsOneGroup) {
  Dag dag;
  const std::vector<Fragment> fragments{sample(dag, 2, 0), sample(dag, -3, 1), sample(dag, 2, 2)};
  const std::vector<FragmentGroup> groups = group_fragments(fragments);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].num_members(), 3U);
  ASSERT_EQ(groups[0].numbers[1].size(), 1U);
  EXPECT_EQ(dag.numbers().value(groups[0].numbers[1][0]), -3.0);
  // The constant read and the output written have equal columns: one entry serves both.
  EXPECT_EQ(groups[0].indices[2], std::vector<int>{2});
}

TEST(GroupFragments, OtherStructureIsAnotherGroup) {
  Dag dag;
  const NodeId u = dag.symbol("u", Stage::state);
  const Inputs inputs{{u, {Slot::displacement, 0}}};
  const NodeId square = dag.multiply(u, u);
  const Fragment other =
      make_fragment(dag, std::vector<NodeId>{square}, std::vector<int>{0}, inputs, SumStyle::plain);
  EXPECT_EQ(group_fragments({sample(dag, 2, 0), other, sample(dag, 2, 0)}).size(), 2U);
}

TEST(Splits, PartitionSummandsAndRows) {
  ASSERT_EQ(all_splits().size(), 16U);
  for (const Split& split : all_splits()) {
    SCOPED_TRACE(split.text());
    std::vector<int> seen(2 * 8, 0);
    for (const EnergyPart& part : energy_parts(split, 2, 8)) {
      for (const auto& [term, point] : part.summands) ++seen[term * 8 + point];
    }
    EXPECT_EQ(seen, std::vector<int>(16, 1));
    std::vector<int> rows(24, 0);
    for (const std::vector<int>& part : row_parts(split, 8, 3)) {
      for (const int row : part) ++rows[row];
    }
    EXPECT_EQ(rows, std::vector<int>(24, 1));
    EXPECT_EQ(Split::parse(split.text()).text(), split.text());
  }
  EXPECT_EQ(energy_parts(Split::parse("lg"), 2, 8).size(), 16U);
  EXPECT_EQ(row_parts(Split::parse("nd"), 8, 3).size(), 24U);
}

TEST(SourceWriter, WrapsCodeAndComments) {
  SourceWriter out;
  out.indent();
  out.line("x = " + std::string(60, 'a') + " + " + std::string(60, 'b') + ";");
  out.line("// " + std::string(60, 'a') + " " + std::string(60, 'b'));
  const std::string text = out.take();
  std::size_t from = 0;
  int lines = 0, comments = 0;
  while (from < text.size()) {
    const std::size_t to = text.find('\n', from);
    EXPECT_LE(to - from, 100U);
    if (text.substr(from, to - from).find("//") != std::string::npos) ++comments;
    ++lines;
    from = to + 1;
  }
  EXPECT_EQ(lines, 4);
  EXPECT_EQ(comments, 2);
}

}  // namespace
}  // namespace elastogen::symgen
