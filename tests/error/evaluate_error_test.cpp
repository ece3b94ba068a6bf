// Cases for `evaluate` that are wrong, and a machine that cannot compile.
#include <nlohmann/json.hpp>

#include "program.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::json;

class Evaluate : public ProgramTest {
 protected:
  Evaluate() {
    case_["rest_positions"] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case_["parameters"] = {{"young", 1e5}, {"poisson", 0.3}};
    case_["displacement"] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}, {0, 0, -0.1}};
    case_["direction"] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    // The determinant of the first permutation that is positive: elements are right-handed.
    if (!is_right_handed()) std::swap(case_["rest_positions"][0], case_["rest_positions"][1]);
  }

  [[nodiscard]] std::vector<std::string> call(const std::string& scalar) const {
    return {"evaluate", "stvk-tet4-q1-none", "--input", "case.json", "--scalar", scalar};
  }

  void expect_case_error(const std::vector<std::string>& words) const {
    write("case.json", case_.dump());
    expect_error(2, call("dag"), words);
  }

  Json case_;

 private:
  [[nodiscard]] bool is_right_handed() const {
    write("case.json", case_.dump());
    return elastogen(call("dag")).exit_status == 0;
  }
};

TEST_F(Evaluate, AgreesForAllScalars) {
  write("case.json", case_.dump());
  const ProcessResult exact = elastogen(call("cln"));
  ASSERT_EQ(exact.exit_status, 0) << exact.output;
  const Json reference = Json::parse(exact.output);
  const double energy = std::stod(reference["energy"].get<std::string>());
  const double force = std::stod(reference["forces"][1][0].get<std::string>());
  const auto number = [](const Json& value) {
    return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
  };
  const double stress = number(reference["stress"][0]["P"][0][0]);
  const double cauchy = number(reference["stress"][0]["cauchy"][0][0]);
  EXPECT_GT(energy, 0);
  for (const std::string scalar : {"double", "float", "simd", "dag"}) {
    std::vector<std::string> arguments = call(scalar);
    arguments.insert(arguments.begin(), "--quiet");
    const ProcessResult result = elastogen(arguments);
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const Json output = Json::parse(result.output);
    const double tolerance = scalar == "float" ? 1e-5 : 1e-14;
    EXPECT_NEAR(output["energy"].get<double>(), energy, tolerance * energy) << scalar;
    EXPECT_NEAR(output["forces"][1][0].get<double>(), force, tolerance * 1e5) << scalar;
    EXPECT_EQ(output["status"], "ok");
    EXPECT_EQ(output["stiffness"].size(), 12U);
    EXPECT_EQ(output["product"].size(), 4U);
    ASSERT_EQ(output["stress"].size(), 1U);
    const Json& point = output["stress"][0];
    EXPECT_NEAR(number(point["P"][0][0]), stress, tolerance * 1e5) << scalar;
    EXPECT_NEAR(number(point["cauchy"][0][0]), cauchy, tolerance * 1e5) << scalar;
    const double volume = number(point["volume"]);
    EXPECT_NEAR(number(point["W"]) * volume, energy, 2 * tolerance * energy) << scalar;
  }
}

TEST_F(Evaluate, RefusesAnUnknownKey) {
  case_["displacment"] = case_["displacement"];
  expect_case_error({"case.json", "unknown key 'displacment'", "did you mean 'displacement'"});
}

TEST_F(Evaluate, RefusesAPoissonRatioOutsideItsRange) {
  for (const double ratio : {0.5, -1.0, 7.0}) {
    case_["parameters"]["poisson"] = ratio;
    expect_case_error({"case.json", "poisson", "(-1, 0.5)"});
  }
}

TEST_F(Evaluate, RefusesAnInvertedElement) {
  std::swap(case_["rest_positions"][0], case_["rest_positions"][1]);
  expect_case_error({"case.json", "inverted"});
}

TEST_F(Evaluate, RefusesADegenerateElement) {
  case_["rest_positions"][3] = case_["rest_positions"][2];
  expect_case_error({"case.json", "degenerate"});
}

TEST_F(Evaluate, RefusesAMissingFile) {
  std::vector<std::string> arguments = call("dag");
  arguments[3] = "nothing.json";
  expect_error(2, arguments, {"input file 'nothing.json' does not exist"});
}

TEST_F(Evaluate, RefusesAGeometryThatDoesNotFit) {
  write("case.json", case_.dump());
  std::vector<std::string> arguments = call("double");
  arguments.insert(arguments.end(), {"--geometry", "box"});
  expect_error(2, arguments, {"axis-aligned box"});
}

TEST_F(Evaluate, SaysPlainlyThatThereIsNoCompiler) {
  write("case.json", case_.dump());
  expect_error(1, call("double"), {"no C++ compiler", "install"}, {"-u", "CXX", "PATH=/nowhere"});
  expect_error(1, call("double"), {"CXX = '/nowhere/c++'"}, {"CXX=/nowhere/c++"});
}

}  // namespace
}  // namespace elastogen::selector
