// What generation promises: the same bytes every time, hashes that follow the law, readable text.
#include <gtest/gtest.h>

#include <algorithm>

#include "element_samples.h"
#include "runtime/error.h"
#include "runtime/kernel_abi.h"
#include "symgen/element/element.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::test {
namespace {

using symgen::AssociationId;
using symgen::Law;

TEST(Generation, SameInputGivesSameBytes) {
  for (const char* text : {"stvk-hexa8-q8-none", "neo_hookean-prism6-q6-lg"}) {
    const AssociationId id = AssociationId::parse(text);
    const auto first = symgen::generate_association(id, law_named(id.law), {});
    const auto second = symgen::generate_association(id, law_named(id.law), {});
    EXPECT_EQ(first.header, second.header);
    EXPECT_EQ(first.hash, symgen::association_hash(id, law_named(id.law), {}));
  }
}

TEST(Generation, HashFollowsLawAndOptions) {
  const AssociationId id = AssociationId::parse("stvk-tet4-q1-none");
  Law law = law_named("stvk");
  const std::string before = symgen::association_hash(id, law, {});
  law.title = "another title";
  EXPECT_EQ(symgen::association_hash(id, law, {}), before);
  law.text += " ";
  EXPECT_NE(symgen::association_hash(id, law, {}), before);
  symgen::GenerateOptions options;
  options.profile = "gpu";
  EXPECT_NE(symgen::association_hash(id, law_named("stvk"), options), before);
}

TEST(Generation, LinesFitAndNamesNoMachine) {
  const AssociationId id = AssociationId::parse("stvk-hexa8-q8-g");
  const std::string text = symgen::generate_association(id, law_named("stvk"), {}).header;
  EXPECT_EQ(text.find("/home"), std::string::npos);
  EXPECT_EQ(text.find(ELASTOGEN_SOURCE_DIR), std::string::npos);
  EXPECT_EQ(text.find(ELASTOGEN_BINARY_DIR), std::string::npos);
  EXPECT_NE(text.find("association  stvk-hexa8-q8-g"), std::string::npos);
}

TEST(Generation, FragmentsThatDifferInNumbersOnlyAreEmittedOnce) {
  const AssociationId id = AssociationId::parse("stvk-hexa8-q8-lgnd");
  const auto generated = symgen::generate_association(id, law_named("stvk"), {});
  EXPECT_NE(generated.header.find("384 fragments, 6 of them different"), std::string::npos);
}

TEST(Generation, AutoSplitsWhatIsTooLarge) {
  const Law law = law_named("stvk");
  const AssociationId id = AssociationId::parse("stvk-hexa8-q27-auto");
  symgen::GenerateOptions options;
  options.profile = "gpu";
  const auto large = symgen::generate_association(id, law, options);
  EXPECT_NE(large.chosen_split, "none");
  EXPECT_NE(large.split_reason.find("flops"), std::string::npos);
  // A loop is never too large.
  EXPECT_EQ(symgen::generate_association(id, law, {}).chosen_split, "none");
}

bool is_loop(const symgen::GeneratedAssociation& generated) {
  return generated.header.find("forces_at_point") != std::string::npos;
}

TEST(Generation, LongKernelsAreLoopsOverPoints) {
  const Law law = law_named("stvk");
  symgen::GenerateOptions straight;
  straight.profile = "gpu";
  for (const char* text : {"stvk-hexa8-q8-none", "stvk-pyramid5-q5-none", "stvk-tet10-q4-none"}) {
    const AssociationId id = AssociationId::parse(text);
    const auto loop = symgen::generate_association(id, law, {});
    const auto line = symgen::generate_association(id, law, straight);
    EXPECT_TRUE(is_loop(loop)) << text;
    EXPECT_FALSE(is_loop(line)) << text;
    EXPECT_LT(loop.header.size(), line.header.size() / 2) << text;
  }
  for (const char* text : {"stvk-tet4-q1-none", "stvk-quad4-q4-none", "stvk-hexa8-q8-g"}) {
    EXPECT_FALSE(is_loop(symgen::generate_association(AssociationId::parse(text), law, {})))
        << text;
  }
}

/// Sum factorisation is found, and the integration costs what the interpolation does: 27 points of
/// a quadratic hexahedron take less than two thirds of what one expression takes.
TEST(Generation, LoopsOfManyPointsSaveOperations) {
  const AssociationId id = AssociationId::parse("stvk-hexa20-q27-none");
  const auto generated = symgen::generate_association(id, law_named("stvk"), {});
  for (const symgen::OperationReport& operation : generated.variants[0].operations) {
    if (operation.name == "product") {
      EXPECT_LT(operation.flops, 19000);
    } else if (operation.name == "forces") {
      EXPECT_LT(operation.flops, 11500);
    }
  }
}

/// Points of a tetrahedron with constant gradients are all the same: nothing varies, no table.
TEST(Generation, EqualFragmentsNeedNoTable) {
  const AssociationId id = AssociationId::parse("stvk-tet4-q4-g");
  const std::string text = symgen::generate_association(id, law_named("stvk"), {}).header;
  for (const char* operation : {"energy", "forces", "product", "linearize", "apply"}) {
    EXPECT_EQ(text.find(std::string(operation) + "_0_row"), std::string::npos) << operation;
  }
  EXPECT_NE(text.find("stress_0_row"), std::string::npos);  // points write numbers of their own
  EXPECT_NE(text.find("for (int k = 0; k < 4; ++k) forces_0<V>"), std::string::npos);
}

/// It reads what every mesh has, so a model may compute it without what its other operations store;
/// of a split it takes g.
TEST(Generation, StressNeedsNoConstants) {
  for (const char* text : {"stvk-hexa8-q8-none", "neo_hookean-tri3-q3-lgnd", "stvk-quad4-q4-nd"}) {
    const AssociationId id = AssociationId::parse(text);
    const auto generated = symgen::generate_association(id, law_named(id.law), {});
    const symgen::Element& element = symgen::find_element(id.element);
    const int num_points = symgen::find_quadrature(id.element, id.quadrature).num_points();
    for (const symgen::VariantReport& variant : generated.variants) {
      const auto stress =
          std::find_if(variant.operations.begin(), variant.operations.end(),
                       [](const auto& operation) { return operation.name == "stress"; });
      ASSERT_NE(stress, variant.operations.end()) << text;
      EXPECT_EQ(stress->constants, 0) << text;
      EXPECT_EQ(stress->state, 0) << text;
      const int num_dofs = element.num_nodes() * element.dim;
      EXPECT_LE(stress->bytes_read, 8 * 2 * num_dofs) << text;
      EXPECT_EQ(stress->bytes_written, 8 * stress_numbers * num_points) << text;
      EXPECT_EQ(stress->fragments, id.split == "lgnd" ? num_points : 1) << text;
      EXPECT_GT(stress->code_bytes, 0) << text;
    }
  }
}

/// The log is of the build that was taken.
TEST(Generation, StagesAreThoseOfOneBuild) {
  const AssociationId id = AssociationId::parse("hooke-hexa8-q8-none");  // its box is straight-line
  const auto generated = symgen::generate_association(id, law_named("hooke"), {});
  ASSERT_EQ(generated.variants.size(), 2U);
  const auto has = [&](std::size_t variant, const std::string& stage) {
    const auto& stages = generated.variants[variant].stages;
    return std::any_of(stages.begin(), stages.end(),
                       [&](const auto& record) { return record.stage == stage; });
  };
  EXPECT_TRUE(has(0, "pointwise_graph"));
  EXPECT_FALSE(has(0, "element_graph"));
  EXPECT_FALSE(has(1, "pointwise_graph"));
  EXPECT_TRUE(has(1, "element_graph"));
  EXPECT_TRUE(has(1, "loops over points (not taken)"));
}

TEST(Generation, ExactQuadratureNeedsAPolynomialLaw) {
  const AssociationId id = AssociationId::parse("neo_hookean-tet4-exact-none");
  EXPECT_THROW((void)symgen::generate_association(id, law_named("neo_hookean"), {}), InputError);
}

TEST(AssociationId, BadTextsAreRefusedWithWhatIsAllowed) {
  for (const char* text : {"stvk", "stvk-hexa8-q8", "stvk-hexa9-q8-none", "stvk-hexa8-q7-none",
                           "stvk-hexa8-q8-gl", "3d-hexa8-q8-none"}) {
    EXPECT_THROW((void)AssociationId::parse(text), InputError) << text;
  }
  try {
    (void)AssociationId::parse("stvk-hexa9-q8-none");
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("hexa8"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace elastogen::test
