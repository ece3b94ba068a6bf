// All 16 splits of every association: the graph after all passes against the exact one before them.
#include <gtest/gtest.h>

#include <cmath>

#include "element_samples.h"

namespace elastogen::test {
namespace {

using symgen::AssociationId;

class Splits : public ::testing::TestWithParam<std::string> {};

double largest(const std::vector<std::string>& texts) {
  double result = 0;
  for (const std::string& text : texts) result = std::max(result, std::abs(std::stod(text)));
  return result;
}

void expect_near(const std::vector<std::string>& found, const std::vector<std::string>& expected,
                 double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    ASSERT_NEAR(std::stod(found[k]), std::stod(expected[k]), tolerance);
  }
}

TEST_P(Splits, AllAgreeWithTheUnsplitExactGraph) {
  AssociationId id = AssociationId::parse(GetParam());
  const symgen::Law law = law_named(id.law);
  const symgen::ElementCase input = sample_case(id, law, {});
  const symgen::Evaluation exact = symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
  const double rounding = 1e-13;
  for (const std::string& split : symgen::split_names()) {
    SCOPED_TRACE(split);
    id.split = split;
    const symgen::Evaluation found =
        symgen::evaluate_graph(id, law, input, symgen::GraphScalar::dag_double);
    ASSERT_EQ(found.status, "ok");
    EXPECT_NEAR(std::stod(found.energy), std::stod(exact.energy),
                rounding * std::stod(exact.energy));
    expect_near(found.forces, exact.forces, rounding * largest(exact.forces));
    expect_near(found.product, exact.product, rounding * largest(exact.stiffness));
    expect_near(found.stiffness, exact.stiffness, rounding * largest(exact.stiffness));
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Splits, ::testing::ValuesIn(unsplit_associations()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace elastogen::test
