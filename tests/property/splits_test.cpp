// All 16 splits of every association: the statements after all passes against the exact graph
// before them.
#include <gtest/gtest.h>

#include "element_samples.h"
#include "evaluations.h"
#include "symgen/element/element.h"

namespace elastogen::test {
namespace {

using symgen::AssociationId;

class Splits : public ::testing::TestWithParam<std::string> {};

TEST_P(Splits, AllAgreeWithTheUnsplitExactGraph) {
  AssociationId id = AssociationId::parse(GetParam());
  const symgen::Law law = law_named(id.law);
  const symgen::ElementCase input = sample_case(id, law, {});
  const symgen::Evaluation exact = symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
  // Of quadratic elements, whose graphs are large, a few.
  const bool is_quadratic = !symgen::find_element(id.element).edges.empty();
  for (const std::string& split :
       is_quadratic ? std::vector<std::string>{"lg", "nd", "auto"} : symgen::split_names()) {
    SCOPED_TRACE(split);
    id.split = split;
    expect_agrees(symgen::evaluate_graph(id, law, input, symgen::GraphScalar::dag_double), exact,
                  1e-13);
  }
}

/// Whatever is stored, and in whatever order points are taken: the same numbers.
TEST(Statements, OfEveryProfileAndGroupingAgreeWithTheExactGraph) {
  for (const char* text : {"neo_hookean-hexa8-q8-none", "stvk-prism6-q21-none",
                           "yeoh-pyramid5-q8-none", "stvk-tet4-q1-lgnd"}) {
    SCOPED_TRACE(text);
    const AssociationId id = AssociationId::parse(text);
    const symgen::Law law = law_named(id.law);
    const symgen::ElementCase input = sample_case(id, law, {});
    const symgen::Evaluation exact =
        symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
    for (const std::string& profile : symgen::profile_names()) {
      for (const auto grouping : {symgen::Grouping::minimum_cut, symgen::Grouping::algorithm6}) {
        SCOPED_TRACE(profile);
        symgen::GenerateOptions options;
        options.profile = profile;
        options.grouping = grouping;
        expect_agrees(
            symgen::evaluate_graph(id, law, input, symgen::GraphScalar::dag_double, options), exact,
            1e-13);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Splits, ::testing::ValuesIn(unsplit_associations()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace elastogen::test
