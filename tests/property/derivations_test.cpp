// Derivatives taken three ways: on the graph, by GiNaC, and of the energy written out in full.
#include <gtest/gtest.h>

#include <algorithm>

#include "element_samples.h"
#include "evaluations.h"
#include "symgen/element/element.h"
#include "symgen/thesis_report.h"

namespace elastogen::test {
namespace {

using symgen::AssociationId;

class Derivations : public ::testing::TestWithParam<std::string> {};

TEST_P(Derivations, GinacAgreesWithTheExactGraphAtEveryStrain) {
  AssociationId id = AssociationId::parse(GetParam());
  const symgen::Law law = law_named(id.law);
  symgen::GenerateOptions by_ginac;
  by_ginac.derivation = symgen::Derivation::ginac;
  struct Sample {
    double strain;
    const char* split;
  };
  std::vector<Sample> samples = {{1e-9, "none"}, {0.1, "lgn"}};
  // Of quadratic elements, whose graphs are large, one.
  if (!symgen::find_element(id.element).edges.empty()) samples.resize(1);
  for (const Sample& sample : samples) {
    SCOPED_TRACE(sample.split);
    const symgen::ElementCase input = sample_case(id, law, {.strain = sample.strain});
    id.split = "none";
    const symgen::Evaluation exact =
        symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
    id.split = sample.split;
    expect_agrees(symgen::evaluate_graph(id, law, input, symgen::GraphScalar::dag_double, by_ginac),
                  exact, 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Derivations, ::testing::ValuesIn(unsplit_walked()),
                         [](const auto& info) { return test_name(info.param); });

TEST(Derivations, ChangeTheHashOfAnAssociation) {
  const AssociationId id = AssociationId::parse("stvk-tet4-q1-none");
  const symgen::Law law = law_named(id.law);
  symgen::GenerateOptions by_ginac;
  by_ginac.derivation = symgen::Derivation::ginac;
  EXPECT_NE(symgen::association_hash(id, law, {}), symgen::association_hash(id, law, by_ginac));
}

class ExpandedFormulation : public ::testing::TestWithParam<std::string> {};

TEST_P(ExpandedFormulation, AgreesWithTheExactGraph) {
  const AssociationId id = AssociationId::parse(GetParam());
  const symgen::Law law = law_named(id.law);
  const symgen::ElementCase input = sample_case(id, law, {});
  symgen::Evaluation exact = symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
  exact.stress.clear();  // the thesis has none
  expect_agrees(symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln_expanded), exact,
                1e-15);
}

// In three dimensions GiNaC expands for most of a minute.
INSTANTIATE_TEST_SUITE_P(Affine, ExpandedFormulation,
                         ::testing::Values("hooke-tet4-q1-none", "stvk-tri3-exact-none"),
                         [](const auto& info) { return test_name(info.param); });
#ifdef ELASTOGEN_CATALOGUE
INSTANTIATE_TEST_SUITE_P(AffineInThreeDimensions, ExpandedFormulation,
                         ::testing::Values("stvk-tet4-exact-none"),
                         [](const auto& info) { return test_name(info.param); });
#endif

struct ThesisCounts {
  std::string association;
  int at_most;  // unsplit constants
  bool equal;   // to the thesis's, not just at most
};

class ThesisTables : public ::testing::TestWithParam<ThesisCounts> {};

TEST_P(ThesisTables, NoFragmentStoresMoreConstants) {
  const AssociationId id = AssociationId::parse(GetParam().association);
  const symgen::ThesisReport report = symgen::thesis_report(id, law_named(id.law));
  ASSERT_TRUE(report.printed);
  const auto variant = std::find_if(
      report.variants.begin(), report.variants.end(),
      [&](const auto& candidate) { return candidate.geometry == report.printed->geometry; });
  ASSERT_NE(variant, report.variants.end());
  EXPECT_LE(variant->constants, GetParam().at_most);
  EXPECT_EQ(report.printed->constants, GetParam().at_most);
  if (GetParam().equal) {
    EXPECT_EQ(variant->constants, GetParam().at_most);
  }
  const int fewest =
      *std::min_element(report.printed->fragments.begin(), report.printed->fragments.end());
  for (const symgen::ThesisFragment& fragment : variant->fragments) {
    EXPECT_LE(fragment.constants, fewest) << fragment.term << " " << fragment.point;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, ThesisTables,
                         ::testing::Values(ThesisCounts{"hooke-tet4-exact-none", 11, true},
                                           ThesisCounts{"hooke-pyramid5-q5-none", 71, false},
                                           ThesisCounts{"stvk-pyramid5-q5-none", 71, false},
                                           ThesisCounts{"hooke-prism6-q6-none", 77, false},
                                           ThesisCounts{"stvk-prism6-q6-none", 77, false},
                                           ThesisCounts{"hooke-hexa8-q8-none", 40, false},
                                           ThesisCounts{"stvk-hexa8-q8-none", 40, false}),
                         [](const auto& info) { return test_name(info.param.association); });

}  // namespace
}  // namespace elastogen::test
