// Exact evaluation of doubles as they are, denormal ones among them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "element_samples.h"
#include "runtime/error.h"
#include "symgen/element_evaluation.h"

namespace elastogen::test {
namespace {

TEST(ExactValue, HoldsEveryDouble) {
  EXPECT_EQ(symgen::exact_value(0.75), cln::cl_RA("3/4"));
  EXPECT_EQ(symgen::exact_value(5e-324), cln::expt(cln::cl_RA(2), -1074));
  EXPECT_EQ(symgen::exact_value(0x1.8p1023), 3 * cln::expt(cln::cl_RA(2), 1022));
  EXPECT_EQ(symgen::exact_value(-0.5), cln::cl_RA("-1/2"));
  EXPECT_THROW((void)symgen::exact_value(NAN), InputError);
  EXPECT_THROW((void)symgen::exact_value(std::numeric_limits<double>::infinity()), InputError);
}

TEST(ExactElement, AgreesWithTheGraphInDouble) {
  const auto id = symgen::AssociationId::parse("stable_neo_hookean-pyramid5-q5-none");
  const symgen::Law law = law_named("stable_neo_hookean");
  const symgen::ElementCase input = sample_case(id, law, {});
  const symgen::ExactElement element(id, law, symgen::Derivation::dag);
  const auto exact = element.evaluate(input, 60, true);
  const symgen::Evaluation found =
      symgen::evaluate_graph(id, law, input, symgen::GraphScalar::dag_double);
  EXPECT_TRUE(exact.inside_domain);
  const double energy = cln::double_approx(exact.energy);
  EXPECT_NEAR(std::stod(found.energy), energy, 1e-14 * energy);
  ASSERT_EQ(exact.stiffness.size(), found.stiffness.size());
  EXPECT_TRUE(element.evaluate(input, 60, false).stiffness.empty());
}

}  // namespace
}  // namespace elastogen::test
