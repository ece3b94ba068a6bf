// Figures of certificates: which are the worst, what counts as worse, what is printed; and the
// inputs that they come from.
#include "selector/certify/certificate_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "runtime/error.h"
#include "symgen/law/law.h"

namespace elastogen::selector {
namespace {

/// One well-posed family and one that is not, with these errors of the forces.
Certificate certificate_with(double well_posed, double relative, int violations = 0) {
  Certificate certificate{"stvk-tet4-q1-none", false, {"lambda", "mu"}, {}};
  FamilyRecord easy{"strain 0.1", true, 5, 0, 0, {}, ""};
  easy.errors[1] = {5, well_posed, 1, well_posed, 2, {}};
  FamilyRecord hard{"slivers", false, 5, 1, violations, {}, ""};
  hard.errors[1] = {4, 1e6, 1e3, relative, 1e9, {}};
  certificate.families = {easy, hard};
  return certificate;
}

nlohmann::json figures(const Certificate& certificate) {
  return nlohmann::json::parse(certificates_json({certificate}, {}).dump());
}

std::vector<std::string> compared(const Certificate& now, const Certificate& before) {
  return worse_than(figures(before), "kept.json", {now}, 2);
}

TEST(CertificateReport, FindsTheWorstOfEachGroup) {
  const Certificate certificate = certificate_with(7, 11);
  EXPECT_EQ(certificate.worst(1, true), 7);
  EXPECT_EQ(certificate.worst(1, false), 11);
  EXPECT_EQ(certificate.worst(0, true), 0);
  const nlohmann::json json = figures(certificate);
  EXPECT_EQ(json["certificates"][0]["conditioned"]["forces"]["family"], "slivers");
  EXPECT_EQ(json["certificates"][0]["families"][1]["forces"]["condition"], 1e9);
}

TEST(CertificateReport, TellsWhatIsWorse) {
  EXPECT_TRUE(compared(certificate_with(10, 10), certificate_with(6, 6)).empty());
  EXPECT_TRUE(compared(certificate_with(8, 8), certificate_with(0.1, 0.1)).empty())
      << "below twice 4 epsilon nothing counts";
  const auto worse = compared(certificate_with(13, 12), certificate_with(6, 6));
  ASSERT_EQ(worse.size(), 1U);
  EXPECT_EQ(worse[0],
            "stvk-tet4-q1-none in double: forces (well-posed) is off by 13.0 epsilon, was 6.0");
  EXPECT_EQ(compared(certificate_with(1, 30), certificate_with(1, 6)).size(), 1U);
  EXPECT_EQ(compared(certificate_with(1, 1, 2), certificate_with(1, 1, 1)).size(), 1U);
}

TEST(CertificateReport, NeedsTheSameAssociationsInABaseline) {
  Certificate other = certificate_with(1, 1);
  other.single_precision = true;
  EXPECT_THROW((void)compared(other, certificate_with(1, 1)), InputError);
  EXPECT_THROW((void)worse_than(nlohmann::json::array(), "kept.json", {other}, 2), InputError);
}

TEST(CertificateReport, PrintsOneLineEach) {
  const std::string table = certificates_table({certificate_with(7, 11, 3)});
  EXPECT_NE(table.find("stvk-tet4-q1-none"), std::string::npos);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  const std::string page = certificates_html({certificate_with(7, 11, 3)}, {});
  EXPECT_NE(page.find("3 violations"), std::string::npos);
}

class Families : public testing::Test {
 protected:
  const symgen::Law law_ = symgen::read_law(ELASTOGEN_SOURCE_DIR "/laws/mooney_rivlin.toml");
  const symgen::Element& element_ = symgen::find_element("pyramid5");
  const ReferenceShape shape_{element_, symgen::find_quadrature("pyramid5", "q5")};
};

TEST_F(Families, MakeSoundElementsWithAdmissibleParameters) {
  for (const CaseFamily& family : case_families()) {
    SCOPED_TRACE(family.name);
    std::mt19937 generator(5);
    for (int k = 0; k < 20; ++k) {
      const symgen::ElementCase input = family.make({shape_, law_, false, generator});
      EXPECT_EQ(input.rest_positions.size(), 15U);
      EXPECT_EQ(input.displacement.size(), 15U);
      EXPECT_GT(shape_.smallest_determinant(input.rest_positions), 0);
      EXPECT_NO_THROW(symgen::check_parameters(law_, input.parameters));
      const bool spoilt = family.name == "not a number" || family.name == "infinity";
      EXPECT_EQ(is_finite(input), !spoilt);
    }
  }
}

TEST_F(Families, PerturbationsAreOfTheLastPlace) {
  std::mt19937 generator(6);
  const symgen::ElementCase input = case_families()[4].make({shape_, law_, true, generator});
  const symgen::ElementCase narrow = rounded(input, true);
  for (const bool single : {true, false}) {
    const double epsilon =
        single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
    const symgen::ElementCase moved = perturbed(narrow, 3, single, generator);
    double largest = 0;
    for (std::size_t k = 3; k < 15; ++k) {
      const double difference = narrow.displacement[k] - narrow.displacement[k % 3];
      const double change = moved.displacement[k] - narrow.displacement[k];
      largest = std::max(largest, std::abs(change / difference) / epsilon);
    }
    EXPECT_GT(largest, 0.3);
    EXPECT_LT(largest, 4);  // the sum is rounded, too
  }
}

}  // namespace
}  // namespace elastogen::selector
