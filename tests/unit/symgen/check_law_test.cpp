// Each property fails on a law that is made to lack it, and holds on those that ship.
#include "symgen/law/check_law.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/error.h"
#include "symgen/law/expression_text.h"
#include "temporary_law.h"

namespace elastogen::symgen {
namespace {

LawCheck check_text(const std::string& text) {
  const TemporaryFolder folder;
  return check_law(parse_law(folder.write("own.toml", text)));
}

/// A law with parameters mu > 0 and lambda >= 0 (unused ones are an error) and terms.
std::string law_text(const std::string& energy, const std::string& keys = "",
                     const std::string& mu_range = "minimum = 0\nminimum_exclusive = true\n") {
  return "name = \"own\"\n" + keys + "[[parameter]]\nname = \"mu\"\nunit = \"Pa\"\n" + mu_range +
         "[[parameter]]\nname = \"lambda\"\nunit = \"Pa\"\nminimum = 0\n[[term]]\nname = "
         "\"all\"\nenergy = \"" +
         energy + "\"\n";
}

std::vector<std::string> failures(const LawCheck& check) {
  std::vector<std::string> names;
  for (const LawProperty& property : check.properties) {
    if (!property.holds) names.push_back(property.name);
  }
  return names;
}

using Names = std::vector<std::string>;

const LawProperty& property(const LawCheck& check, const std::string& name) {
  const auto found = std::find_if(check.properties.begin(), check.properties.end(),
                                  [&](const LawProperty& p) { return p.name == name; });
  if (found == check.properties.end()) throw InternalError("no property " + name);
  return *found;
}

class SoundLaw : public testing::TestWithParam<std::string> {};

TEST_P(SoundLaw, HasEveryProperty) {
  const LawCheck check =
      check_law(parse_law(std::string(ELASTOGEN_SOURCE_DIR) + "/" + GetParam() + ".toml"));
  EXPECT_EQ(failures(check), Names{});
  for (const char* name :
       {"stress and tangent", "symmetric tangent", "positive definite at rest", "moduli at rest"}) {
    EXPECT_TRUE(property(check, name).holds) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SoundLaw,
                         testing::Values("laws/hooke", "laws/stvk", "laws/neo_hookean",
                                         "tests/data/laws/gent", "tests/data/laws/linlog"),
                         [](const auto& law) {
                           return law.param.substr(law.param.find_last_of('/') + 1);
                         });

struct Lacking {
  const char *name, *text_energy;
  Names fails;
};

class LawLacking : public testing::TestWithParam<Lacking> {};

TEST_P(LawLacking, AProperty) {
  EXPECT_EQ(failures(check_text(law_text(GetParam().text_energy))), GetParam().fails);
}

INSTANTIATE_TEST_SUITE_P(
    All, LawLacking,
    testing::Values(Lacking{"Energy", "mu*trE2 + lambda*(trE^2 + 1)", {"zero energy at rest"}},
                    Lacking{"StressFree", "mu/2*(I1 - 3) + lambda*trE^2", {"stress-free at rest"}},
                    Lacking{"Objectivity", "mu*tr_eps2 + lambda*tr_eps^2", {"objective"}},
                    Lacking{
                        "Definiteness", "-mu*trE2 + lambda*trE^2", {"positive definite at rest"}},
                    Lacking{"Shear", "lambda*trE^2 + mu*trE2^2", {"positive definite at rest"}},
                    Lacking{"Logarithm",
                            "mu*trE2 + lambda*log(trE)",
                            {"zero energy at rest", "stress-free at rest"}},
                    Lacking{"Kink",
                            "lambda*trE^2 + mu*sqrt(trE2)",
                            {"zero energy at rest", "stress-free at rest"}}),
    [](const auto& lacking) { return lacking.param.name; });

TEST(PositiveDefinite, FailsAtABoundThatBelongsToTheRange) {
  const LawCheck check = check_text(law_text("mu*trE2 + lambda*trE^2", "", "minimum = 0\n"));
  EXPECT_EQ(failures(check), Names{"positive definite at rest"});
  EXPECT_NE(property(check, "positive definite at rest").detail.find("mu = 0"), std::string::npos);
}

TEST(PositiveDefinite, IsMeasuredWhereRootsOfParametersStandInTheWay) {
  const LawCheck check =
      check_text(law_text("mu*sqrt(1 + lambda/mu)*trE2 + sqrt(lambda*mu)*trE^2"));
  EXPECT_EQ(failures(check), Names{});
  EXPECT_EQ(property(check, "positive definite at rest").evidence, Evidence::measured);
}

TEST(PositiveDefinite, FailsWhereTheTangentIsNotFiniteAtRest) {
  const LawCheck check = check_text(law_text("mu*trE2 + lambda*trE2^(3/2)"));
  EXPECT_EQ(failures(check), Names{"positive definite at rest"});
  EXPECT_NE(property(check, "positive definite at rest").detail.find("not finite at rest"),
            std::string::npos);
}

TEST(EveryTerm, IsJudgedByItself) {
  const std::string second = "[[term]]\nname = \"log\"\nenergy = \"lambda*trE^2 - mu*log(J)\"\n";
  const LawCheck check = check_text(law_text("mu/2*(I1 - 3)") + second);
  EXPECT_EQ(failures(check), (Names{"stress-free at rest", "stress-free at rest"}));
}

TEST(SmallStrainLaw, IsStatedWhereTheFileSaysSo) {
  const LawCheck check =
      check_text(law_text("mu*tr_eps2 + lambda*tr_eps^2", "small_strain = true\n"));
  EXPECT_EQ(failures(check), Names{});
  EXPECT_EQ(property(check, "objective").evidence, Evidence::stated);
}

TEST(DeclaredModuli, AreCompared) {
  const std::string energy = "mu*trE2 + lambda*trE^2";
  const std::string right = "[moduli]\nlambda = \"2*lambda\"\nmu = \"mu\"\n";
  const std::string wrong = "[moduli]\nlambda = \"lambda\"\nmu = \"mu\"\n";
  EXPECT_EQ(failures(check_text(law_text(energy, right))), Names{});
  const LawCheck check = check_text(law_text(energy, wrong));
  EXPECT_EQ(failures(check), Names{"moduli at rest"});
  EXPECT_NE(property(check, "moduli at rest").detail.find("2*lambda"), std::string::npos);
}

TEST(DeclaredModuli, OfYoungAndPoissonAreCompared) {
  const std::string law =
      "name = \"own\"\n[[parameter]]\nname = \"mu\"\nunit = \"Pa\"\n"
      "from_young_poisson = \"young/(1 + poisson)\"\n"
      "[[term]]\nname = \"shear\"\nenergy = \"mu*trE2\"\n";
  EXPECT_EQ(failures(check_text(law)), Names{"moduli at rest"});
}

TEST(PrintedStress, IsThatOfTheBooks) {
  const LawCheck check = check_law(shipped_law("neo_hookean"));
  // S = mu I + (lambda ln J - mu) C^-1, Bonet & Wood, eq. 6.28
  EXPECT_EQ(expression_text(check.stress.stress[0]), "mu");
  EXPECT_EQ(expression_text(check.stress.stress[3]), "lambda*log(J) - mu");
  EXPECT_EQ(expression_text(check.stress.tangent[3][3]), "lambda");
  EXPECT_EQ(expression_text(check.moduli.lambda), "lambda");
  EXPECT_EQ(expression_text(check.moduli.mu), "mu");
}

TEST(SmallStrainDigits, AreKeptByRecognisedFormsAndLostByOthers) {
  const LawCheck kept = check_law(shipped_law("neo_hookean"));
  for (const SmallStrainDigits& entry : kept.digits) {
    EXPECT_TRUE(entry.stabilised);
    for (const int digits : entry.digits) EXPECT_GE(digits, 14) << entry.term;
  }
  const LawCheck lost = check_text(law_text("mu*trE2 + (lambda + mu)*(J^20 - 20*J + 19)"));
  ASSERT_EQ(failures(lost), Names{});
  EXPECT_FALSE(lost.digits[0].stabilised);
  EXPECT_LE(lost.digits[0].digits.back(), 9);
  EXPECT_TRUE(std::any_of(lost.notes.begin(), lost.notes.end(), [](const std::string& note) {
    return note.find("is not rewritten for small strain") != std::string::npos;
  }));
}

}  // namespace
}  // namespace elastogen::symgen
