// A law file of the user's own that is wrong: file and line, and nothing generated.
#include "program.h"

namespace elastogen::selector {
namespace {

class LawFile : public ProgramTest {
 protected:
  /// Line 3 declares the parameter, line 9 is the energy.
  static std::string law(const std::string& parameter, const std::string& energy) {
    return "name = \"mine\"\ntitle = \"Mine\"\n[[parameter]]\nname = \"" + parameter +
           "\"\nunit = \"Pa\"\ndescription = \"modulus\"\n[[term]]\nname = \"only\"\nenergy = \"" +
           energy + "\"\n";
  }

  void expect_law_error(const std::string& text, const std::vector<std::string>& words) const {
    write("laws/mine.toml", text);
    expect_error(2, {"generate", "mine-tet4-q1-none", "--laws", "laws", "--out", "kernels"}, words);
    expect_error(2, {"explain", "mine-tet4-q1-none", "--laws", "laws"}, words);
  }
};

TEST_F(LawFile, OfOnesOwnIsUsed) {
  write("laws/mine.toml", "source = \"none\"\n" + law("mu", "mu*trE2"));
  const ProcessResult result =
      elastogen({"generate", "mine-tet4-q1-none", "--laws", "laws", "--out", "kernels"});
  EXPECT_EQ(result.exit_status, 0) << result.output;
}

TEST_F(LawFile, WithAnUnknownSymbol) {
  expect_law_error("source = \"none\"\n" + law("mu", "mu*trE3"), {"mine.toml:10", "trE3", "trE2"});
}

TEST_F(LawFile, WithANameThatIsNoIdentifier) {
  expect_law_error("source = \"none\"\n" + law("2mu", "trE2"), {"mine.toml:5", "2mu"});
}

TEST_F(LawFile, WithATermThatDoesNotParse) {
  expect_law_error("source = \"none\"\n" + law("mu", "mu*(trE2"), {"mine.toml:10"});
}

TEST_F(LawFile, WithAnUnknownKey) {
  expect_law_error("sorce = \"none\"\n" + law("mu", "mu*trE2"), {"mine.toml:1", "sorce", "source"});
}

TEST_F(LawFile, WithAnEnergyInAWrongUnit) {
  expect_law_error("source = \"none\"\n" + law("mu", "mu^2*trE2"),
                   {"mine.toml:10", "'mu^2*trE2' is in Pa^2", "must be in J/m^3"});
}

TEST_F(LawFile, ThatIsNoToml) { expect_law_error("name = \n", {"mine.toml:1"}); }

}  // namespace
}  // namespace elastogen::selector
