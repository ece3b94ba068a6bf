// Splits of associations: the statements after all passes against the exact graph before them.
#include <gtest/gtest.h>

#include <algorithm>

#include "element_samples.h"
#include "evaluations.h"
#include "symgen/element/element.h"

namespace elastogen::test {
namespace {

using symgen::AssociationId;

/// Of an association, four of the 16 splits, so that each four associations have all; in the
/// catalogue all 16. Of quadratic elements, whose graphs are large, a few.
std::vector<std::string> splits_of(const std::string& association) {
  const AssociationId id = AssociationId::parse(association);
  if (!symgen::find_element(id.element).edges.empty()) return {"lg", "nd", "auto"};
  const std::vector<std::string> all = symgen::split_names();
#ifdef ELASTOGEN_CATALOGUE
  return all;
#else
  const std::vector<std::string> tested = unsplit_walked();
  const auto place = std::find(tested.begin(), tested.end(), association) - tested.begin();
  std::vector<std::string> some;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k % 4 == static_cast<std::size_t>(place) % 4) some.push_back(all[k]);
  }
  return some;
#endif
}

class Splits : public ::testing::TestWithParam<std::string> {};

TEST_P(Splits, AgreeWithTheUnsplitExactGraph) {
  AssociationId id = AssociationId::parse(GetParam());
  const symgen::Law law = law_named(id.law);
  const symgen::ElementCase input = sample_case(id, law, {});
  const symgen::Evaluation exact = symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
  for (const std::string& split : splits_of(GetParam())) {
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

INSTANTIATE_TEST_SUITE_P(Every, Splits, ::testing::ValuesIn(unsplit_walked()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace elastogen::test
