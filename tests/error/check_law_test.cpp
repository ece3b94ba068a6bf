// `check-law` as a user meets it: exit statuses, the failing property, JSON.
#include <nlohmann/json.hpp>

#include "program.h"

namespace elastogen::selector {
namespace {

class CheckLaw : public ProgramTest {
 protected:
  void write_law(const std::string& energy) const {
    write("own.toml",
          "name = \"own\"\n[[parameter]]\nname = \"mu\"\nunit = \"Pa\"\nminimum = 1\n"
          "[[term]]\nname = \"shear\"\nenergy = \"" +
              energy + "\"\n");
  }
};

TEST_F(CheckLaw, AcceptsASoundLaw) {
  write_law("mu*trE2");
  const ProcessResult result = elastogen({"check-law", "own.toml"});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_NE(result.output.find("S = 2*mu*E"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("parameter mu [Pa]\n"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("term shear [J/m^3]: mu*trE2\n"), std::string::npos);
}

TEST_F(CheckLaw, NamesThePropertyThatFails) {
  write_law("mu/2*(I1 - 3)");
  expect_error(1, {"check-law", "own.toml"},
               {"own.toml:8: term 'shear': 'stress-free at rest' fails"});
  write_law("mu*tr_eps2");
  expect_error(1, {"check-law", "own.toml"}, {"'objective' fails", "small_strain = true"});
}

TEST_F(CheckLaw, RefusesWhatIsNoLaw) {
  write_law("mu*trE3");
  expect_error(2, {"check-law", "own.toml"}, {"own.toml:8", "trE3"});
  write_law("trE2/mu");
  expect_error(2, {"check-law", "own.toml"}, {"own.toml:8", "is in 1/Pa", "must be in J/m^3"});
  expect_error(2, {"check-law", "nowhere.toml"}, {"nowhere.toml", "does not exist"});
  expect_error(2, {"check-law", "stvc"}, {"unknown law 'stvc'", "did you mean 'stvk'"});
  expect_error(2, {"check-law"}, {"FILE"});
}

TEST_F(CheckLaw, PrintsJson) {
  const ProcessResult result = elastogen({"check-law", "hooke", "--json"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["holds"], true);
  EXPECT_EQ(json["parameters"][1]["unit"], "Pa");
  EXPECT_EQ(json["terms"][0]["unit"], "J/m^3");
  EXPECT_EQ(json["properties"][2]["name"], "objective");
  EXPECT_EQ(json["properties"][2]["how"], "stated");
  EXPECT_EQ(json["moduli_at_rest"]["mu"], "mu");
  EXPECT_EQ(json["tangent_at_rest"].size(), 6U);
}

}  // namespace
}  // namespace elastogen::selector
