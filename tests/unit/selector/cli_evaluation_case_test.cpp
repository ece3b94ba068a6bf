#include <gtest/gtest.h>

#include "runtime/error.h"
#include "selector/commands/evaluation_case.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {

class EvaluationCase : public ::testing::Test {
 protected:
  symgen::ElementCase read(const std::string& text) const {
    return read_evaluation_case(text, "case.json", law_, element_);
  }

  /// A case of the unit tetrahedron with some parameters and further keys.
  static std::string with(const std::string& parameters, const std::string& more = "") {
    return R"({"rest_positions": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "parameters": {)" + parameters +
           R"(}, "displacement": [[0,0,0],[0.5,0,0],[0,0,0],[0,0,0]])" + more + "}";
  }

  void expect_refused(const std::string& text, const std::vector<std::string>& words) const {
    const std::string message = message_of<InputError>([&] { (void)read(text); });
    EXPECT_TRUE(message.starts_with("case.json")) << message;
    for (const std::string& word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
    }
  }

  symgen::Law law_ = symgen::read_law(ELASTOGEN_SOURCE_DIR "/laws/stvk.toml");
  const symgen::Element& element_ = symgen::find_element("tet4");
};

TEST_F(EvaluationCase, ReadsNodeMajor) {
  const symgen::ElementCase input = read(with(R"("lambda": 2, "mu": 3)"));
  EXPECT_EQ(input.displacement, (std::vector<double>{0, 0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(input.direction.empty());
  ASSERT_EQ(law_.parameters.size(), 2U);
  const bool lambda_first = law_.parameters[0].name == "lambda";
  EXPECT_EQ(input.parameters,
            lambda_first ? (std::vector<double>{2, 3}) : (std::vector<double>{3, 2}));
}

TEST_F(EvaluationCase, TakesYoungAndPoisson) {
  const symgen::ElementCase by_young = read(with(R"("young": 1e5, "poisson": 0.25)"));
  const symgen::ElementCase by_name = read(with(R"("lambda": 4e4, "mu": 4e4)"));
  ASSERT_EQ(by_young.parameters.size(), by_name.parameters.size());
  for (std::size_t k = 0; k < by_name.parameters.size(); ++k) {
    EXPECT_NEAR(by_young.parameters[k], by_name.parameters[k], 1e-9);
  }
}

TEST_F(EvaluationCase, RefusesWhatIsNoJson) {
  expect_refused("{\n  \"parameters\": ]", {"not valid JSON", "line 2"});
}

TEST_F(EvaluationCase, RefusesUnknownAndMissingKeys) {
  expect_refused(with(R"("lambda": 2, "mu": 3)", R"(, "dircetion": [])"),
                 {"unknown key 'dircetion'", "did you mean 'direction'"});
  expect_refused(with(R"("lambda": 2, "nu": 3)"), {"unknown key 'nu'", "did you mean 'mu'"});
  expect_refused(with(R"("young": 2, "mu": 3)"), {"unknown key 'mu'", "young, poisson"});
  expect_refused(with(R"("lambda": 2)"), {"'mu' is missing"});
  expect_refused(R"({"parameters": {"lambda": 1, "mu": 1}})", {"'rest_positions' is missing"});
}

TEST_F(EvaluationCase, RefusesWrongSizesAndTypes) {
  expect_refused(with(R"("lambda": 2, "mu": 3)", R"(, "direction": [[0,0,0]])"),
                 {"direction", "found 1 rows", "4 nodes"});
  expect_refused(
      with(R"("lambda": 2, "mu": 3)", R"(, "direction": [[0,0,0],[0,0,0],[0,0],[0,0,0]])"),
      {"direction[2]", "3 coordinates"});
  expect_refused(with(R"("lambda": "2", "mu": 3)"), {"parameters.lambda", "must be a number"});
  expect_refused(with(R"("lambda": 1e999, "mu": 3)"), {"case.json"});
}

TEST_F(EvaluationCase, RefusesAPoissonRatioOutsideItsRange) {
  expect_refused(with(R"("young": 1e5, "poisson": 0.5)"), {"parameters", "0.5", "(-1, 0.5)"});
}

TEST_F(EvaluationCase, RefusesInvertedAndDegenerateElements) {
  const symgen::Quadrature& rule = symgen::find_quadrature("tet4", "q1");
  symgen::ElementCase input = read(with(R"("lambda": 2, "mu": 3)"));
  EXPECT_NO_THROW(check_rest_shape(input, "case.json", element_, rule));
  for (const auto& [scale, word] : {std::pair{-1.0, "inverted"}, std::pair{0.0, "degenerate"}}) {
    symgen::ElementCase bad = input;
    for (std::size_t k = 0; k < bad.rest_positions.size(); k += 3) bad.rest_positions[k] *= scale;
    const std::string message =
        message_of<InputError>([&] { check_rest_shape(bad, "case.json", element_, rule); });
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_NE(message.find("quadrature point 1 of 1"), std::string::npos) << message;
  }
}

TEST(RestShape, IsABoxOnlyInTheElementsNodeOrder) {
  const symgen::Element& hexa = symgen::find_element("hexa8");
  symgen::ElementCase input;
  for (const std::vector<GiNaC::ex>& node : hexa.nodes) {
    for (const GiNaC::ex& x : node) {
      input.rest_positions.push_back(3 + 2 * GiNaC::ex_to<GiNaC::numeric>(x).to_double());
    }
  }
  EXPECT_NO_THROW(check_rest_shape_is("box", input, "case.json", hexa));
  input.rest_positions[0] += 1e-6;
  EXPECT_THROW(check_rest_shape_is("box", input, "case.json", hexa), InputError);
}

}  // namespace
}  // namespace elastogen::selector
