#include "symgen/law/law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "runtime/error.h"
#include "symgen/law/rest_state.h"
#include "symgen/mechanics/invariants.h"
#include "temporary_law.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

ex invariant(const char* name) { return find_invariant(name).symbol; }

TEST(ShippedLaws, AreFoundByName) {
  const std::filesystem::path folder = std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "laws";
  const std::vector<std::string> names = law_names({folder});
  for (const char* name : {"hooke", "neo_hookean", "stvk"}) {
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  }
  EXPECT_EQ(find_law_file("stvk", {"no_such_folder", folder}), folder / "stvk.toml");
}

TEST(ShippedLaws, HaveTheirTermsAndParameters) {
  const Law stvk = shipped_law("stvk");
  ASSERT_EQ(stvk.parameters.size(), 2U);
  EXPECT_EQ(stvk.parameters[0].name, "lambda");
  EXPECT_EQ(stvk.parameters[1].name, "mu");
  EXPECT_EQ(stvk.parameters[1].unit_name, "Pa");
  EXPECT_EQ(stvk.parameters[1].minimum, numeric(0));
  EXPECT_TRUE(stvk.parameters[1].minimum_exclusive);
  ASSERT_EQ(stvk.terms.size(), 2U);
  const ex lambda = stvk.parameters[0].symbol, mu = stvk.parameters[1].symbol;
  EXPECT_TRUE(stvk.terms[0].expression.is_equal(lambda / 2 * GiNaC::pow(invariant("trE"), 2)));
  EXPECT_TRUE(stvk.terms[1].expression.is_equal(mu * invariant("trE2")));
  EXPECT_TRUE(stvk.polynomial);

  const Law hooke = shipped_law("hooke");
  ASSERT_EQ(hooke.terms.size(), 2U);
  EXPECT_TRUE(hooke.polynomial);

  const Law neo = shipped_law("neo_hookean");
  ASSERT_EQ(neo.terms.size(), 2U);
  EXPECT_FALSE(neo.polynomial);
  const ex shear = neo.parameters[1].symbol;
  EXPECT_TRUE((neo.terms[0].expression - shear / 2 * (invariant("I1") - 3) +
               shear * GiNaC::log(invariant("J")))
                  .expand()
                  .is_zero());
}

TEST(LawText, DependsOnWhatKernelsDependOn) {
  const std::string law = R"(name = "own"
[[parameter]]
name = "mu"
unit = "Pa"
[[term]]
name = "shear"
energy = "mu*trE2"
)";
  const std::string text = law_from_text("own", law).text;
  EXPECT_EQ(text, "law own\nparameter mu\nterm shear = mu*trE2\n");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = law;
    other.replace(other.find(from), from.size(), to);
    return law_from_text("own", other).text;
  };
  EXPECT_EQ(changed("name = \"own\"", "# comment\nname = \"own\"\ntitle = \"T\""), text);
  EXPECT_EQ(changed("unit = \"Pa\"", "unit = \"N/m^2\"\ndescription = \"d\"\nminimum = 0"), text);
  EXPECT_EQ(changed("mu*trE2", "mu * trE2"), text);
  EXPECT_NE(changed("mu*trE2", "2*mu*trE2"), text);
  EXPECT_NE(changed("shear", "other"), text);
}

TEST(LawPolynomial, IsDecidedSymbolically) {
  EXPECT_TRUE(law_with_term("mu*(J - 1)^2 + lambda*(sqrt(I3) - 1)^2").polynomial);
  EXPECT_TRUE(law_with_term("mu*trE2 + lambda*(J^2 - 1)^2/(J + 1)").polynomial);
  EXPECT_TRUE(law_with_term("mu*tr_eps2 + lambda^2/mu*tr_eps^2").polynomial);
  EXPECT_FALSE(law_with_term("mu*trE2 + lambda*log(J)^2").polynomial);
  EXPECT_FALSE(law_with_term("mu*trE2 + lambda*(1/J - 1)^2").polynomial);
  EXPECT_FALSE(law_with_term("lambda*trE^2 + mu*(I1*J^(-2/3) - 3)").polynomial);
}

TEST(LawDocumentation, HasAnExampleThatWorks) {
  std::ifstream file(std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "docs" / "laws.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string opening = "```toml\n";
  const std::size_t begin = page.find(opening);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t text = begin + opening.size();
  const Law law = law_from_text("ciarlet", page.substr(text, page.find("```", text) - text));
  EXPECT_EQ(law.parameters.size(), 3U);
  EXPECT_EQ(law.terms.size(), 2U);
}

TEST(LawDocumentation, ListsEveryInvariant) {
  std::ifstream file(std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "docs" / "laws.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& name : invariant_names()) {
    EXPECT_NE(page.find("| `" + name + "` |"), std::string::npos) << name;
  }
}

TEST(RestState, IsDerivedFromTheInvariants) {
  const RestState volume = rest_state(invariant("J"));
  EXPECT_EQ(volume.energy, ex(1));
  for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(volume.stress[c], ex(c % 4 == 0 ? 1 : 0));
  const RestState second = rest_state(invariant("I2"));
  EXPECT_EQ(second.energy, ex(3));
  EXPECT_EQ(second.stress[0], ex(4));
  EXPECT_EQ(second.stress[1], ex(0));
}

// Terms whose first-order parts cancel only after the functions are resolved.
TEST(ReadLaw, AcceptsTermsThatAreStressFreeTogether) {
  EXPECT_NO_THROW((void)law_with_term("mu/2*(I1*J^(-2/3) - 3) + lambda*(J - 1)^2"));
  EXPECT_NO_THROW((void)law_with_term("mu/4*(I3 - 1 - 2*log(J)) + lambda*trE2"));
  EXPECT_NO_THROW((void)law_with_term("lambda*(exp(mu/lambda*trE2) - 1)"));
  EXPECT_NO_THROW((void)law_with_term("mu*(I1 - 3) + lambda*(I2 - 3) - (2*mu + 4*lambda)*log(J)"));
}

TEST(FindLawFile, NamesKnownLawsAndFolders) {
  const TemporaryFolder folder;
  (void)folder.write("ogden.toml", "");
  (void)folder.write("yeoh.toml", "");
  (void)folder.write("notes.txt", "");
  EXPECT_EQ(law_names({folder.path(), folder.path(), "no_such_folder"}),
            (std::vector<std::string>{"ogden", "yeoh"}));
  try {
    (void)find_law_file("ogdne", {folder.path()});
    FAIL() << "ogdne was found";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(),
              "unknown law 'ogdne'; did you mean 'ogden'?; laws are ogden, yeoh "
              "(files NAME.toml in " +
                  folder.path().string() + ")");
  }
  EXPECT_THROW(
      (void)find_law_file("../" + folder.path().filename().string() + "/ogden", {folder.path()}),
      InputError);
}

TEST(ReadLaw, RefusesMissingFile) {
  EXPECT_THROW((void)read_law("no_such_folder/law.toml"), InputError);
  EXPECT_THROW((void)read_law(testing::TempDir()), InputError);
}

}  // namespace
}  // namespace elastogen::symgen
