// The scenes of scenes/stress with the laws that each is for: what must hold (docs/stability.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

/// A stress scene with another law.
std::string stress_scene(const std::string& name, const std::string& law) {
  std::string text = read_text_file(
      std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "scenes" / "stress" / (name + ".toml"),
      "scene");
  const std::string shipped = "stable_neo_hookean-";
  for (std::size_t at = text.find(shipped); at != std::string::npos;
       at = text.find(shipped, at + law.size())) {
    text.replace(at, shipped.size(), law + "-");
  }
  if (law == "mooney_rivlin" || law == "yeoh") {
    const std::string rubber = law == "yeoh" ? "c1 = 2e4\nc2 = -500\nc3 = 200\nkappa = 1e5"
                                             : "c1 = 1.4e4\nc2 = 5e3\nkappa = 1e5";
    text = replaced_once(text, "young = 1e5       # Pa\npoisson = 0.3", rubber);
  }
  return text;
}

class Stress : public Run {
 protected:
  [[nodiscard]] nlohmann::json run_stress(const std::string& text) const {
    const ProcessResult result = run_scene(write(text));
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return summary();
  }

  /// A column of history.csv.
  [[nodiscard]] std::vector<double> history(const std::string& column) const {
    std::istringstream text(read_text_file(out() / "history.csv", "history"));
    std::string line, field;
    std::getline(text, line);
    std::istringstream names(line);
    std::size_t wanted = 0;
    while (std::getline(names, field, ',') && field != column) ++wanted;
    std::vector<double> values;
    while (std::getline(text, line)) {
      std::istringstream fields(line);
      for (std::size_t k = 0; k <= wanted; ++k) std::getline(fields, field, ',');
      values.push_back(std::stod(field));
    }
    return values;
  }
};

class LargeStrain : public Stress, public testing::WithParamInterface<const char*> {};

TEST_P(LargeStrain, IsReachedInStretch) {
  const nlohmann::json end = run_stress(stress_scene("stretch", GetParam()))["probes"][0];
  EXPECT_NEAR(end["displacement"][0], 8, 1e-12);
  EXPECT_GT(end["reaction"][0], 0);
}

TEST_P(LargeStrain, IsReachedInCompression) {
  const nlohmann::json json = run_stress(stress_scene("compression", GetParam()));
  EXPECT_EQ(json["solver"]["status"], "converged");
  EXPECT_NEAR(json["probes"][0]["displacement"][0], -1.9, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, LargeStrain,
                         testing::Values("stvk", "neo_hookean", "stable_neo_hookean",
                                         "mooney_rivlin", "yeoh"),
                         [](const auto& law) { return std::string(law.param); });

TEST_F(Stress, TwistByThreeTurnsIsResisted) {
  for (const char* law : {"neo_hookean", "stable_neo_hookean"}) {
    (void)run_stress(stress_scene("twist", law));
    const std::vector<double> moment = history("end_mx");
    EXPECT_TRUE(std::all_of(moment.begin() + 1, moment.end(), [](double m) { return m > 0; }))
        << law;
  }
}

class BadStart : public Stress, public testing::WithParamInterface<const char*> {};

TEST_P(BadStart, FindsTheShapeAtRest) {
  for (const char* law : {"stable_neo_hookean", "hooke"}) {
    const nlohmann::json json = run_stress(stress_scene(GetParam(), law));
    EXPECT_LT(json["solver"]["energy"], 1e-4) << law;  // of moduli of 1e5 Pa in 2 m^3
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(json["probes"][0]["displacement"][c], 0, 1e-4) << law;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadStart, testing::Values("inverted", "flattened", "scrambled"),
                         [](const auto& start) { return std::string(start.param); });

TEST_F(Stress, LawsWithLogarithmsRefuseABadStart) {
  const ProcessResult result = run_scene(write(stress_scene("inverted", "neo_hookean")));
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("outside the domain of its law"), std::string::npos)
      << result.output;
}

TEST_F(Stress, StiffnessContrastLeavesTheSoftPartAllTheStretch) {
  const nlohmann::json json = run_stress(stress_scene("contrast", "neo_hookean"));
  // Of 2 m half is soft: a stretch of 1.2 there, held at both sides.
  const double force = json["probes"][0]["reaction"][0];
  EXPECT_GT(force, 1e5 * 0.2 * 0.9);
  EXPECT_LT(force, 1e5 * 0.2 * 1.3);
}

TEST_F(Stress, UndampedSwingKeepsItsHeightForAHundredThousandSteps) {
  (void)run_stress(stress_scene("swing", "stable_neo_hookean"));
  const std::vector<double> height = history("end_uz");
  const auto piece = static_cast<std::ptrdiff_t>(height.size() / 5);
  for (int k = 0; k < 5; ++k) {
    const auto [low, high] =
        std::minmax_element(height.begin() + k * piece, height.begin() + (k + 1) * piece);
    EXPECT_NEAR(*low, -3.7, 0.15);
    EXPECT_NEAR(*high, 0, 0.15);
  }
}

struct Drift {
  const char* scheme;
  double angular_momentum;  ///< greatest change, relative
  double energy;            ///< likewise
};

class FreeSpin : public Stress, public testing::WithParamInterface<Drift> {};

TEST_P(FreeSpin, KeepsMomentumAndEnergyForAHundredThousandSteps) {
  (void)run_stress(replaced_once(stress_scene("free_spin", "stable_neo_hookean"),
                                 "central_differences", GetParam().scheme));
  constexpr double mass = 1000, gravity = -0.1;
  const Eigen::Vector3d spin(0.1, 0.2, 1.0);
  const std::vector<double> time = history("time");
  const std::vector<double> kinetic = history("kinetic_energy"),
                            elastic = history("elastic_energy");
  std::array<std::vector<double>, 3> momentum, angular;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string axis(1, "xyz"[c]);
    momentum[c] = history("momentum_" + axis);
    angular[c] = history("angular_momentum_" + axis);
  }
  Eigen::Vector3d at_start = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < time.size(); ++k) {
    const Eigen::Vector3d p(momentum[0][k], momentum[1][k], momentum[2][k]);
    const Eigen::Vector3d weight(0, 0, mass * gravity);
    EXPECT_LT((p - weight * time[k]).norm(), 1e-12 * weight.norm() * time.back()) << k;
    // What the falling centre of mass has is taken off.
    const Eigen::Vector3d centre(1, 0.5, 0.25 + 0.5 * gravity * time[k] * time[k]);
    const Eigen::Vector3d l =
        Eigen::Vector3d(angular[0][k], angular[1][k], angular[2][k]) - centre.cross(p);
    if (k == 0) at_start = l;
    EXPECT_LT((l - at_start).norm(), GetParam().angular_momentum * at_start.norm()) << k;
    const double energy = kinetic[k] + elastic[k] - p.squaredNorm() / (2 * mass);
    EXPECT_NEAR(energy / (0.5 * spin.dot(at_start)), 1, GetParam().energy) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(All, FreeSpin,
                         testing::Values(Drift{"central_differences", 1e-9, 1e-5},
                                         Drift{"symplectic_euler", 1e-9, 5e-4}),
                         [](const auto& drift) { return std::string(drift.param.scheme); });

TEST_F(Stress, SliverInAGoodMeshIsHarmless) {
  for (const char* law : {"hooke", "stvk", "neo_hookean", "stable_neo_hookean"}) {
    for (const char* method : {"cg", "cholesky"}) {
      const std::string scene = replaced_once(stress_scene("sliver", law), "\"cholesky\"",
                                              '"' + std::string(method) + '"');
      const nlohmann::json with = run_stress(scene);
      const std::size_t comment = scene.find("# the sliver");
      const std::size_t line = scene.rfind('\n', comment);
      const nlohmann::json without = run_stress(scene.substr(0, line) + scene.substr(comment));
      const double force = without["probes"][0]["reaction"][0];
      const double stiffened = with["probes"][0]["reaction"][0].get<double>() / force;
      EXPECT_GT(stiffened, 1) << law << ' ' << method;
      EXPECT_LT(stiffened, 1.12) << law << ' ' << method;  // of two cubes, whose face it holds
      EXPECT_LT(with["solver"]["newton_iterations"], 10) << law << ' ' << method;
    }
  }
}

TEST_F(Stress, QuadraticElementsDoNotLockWhereLinearOnesDo) {
  const std::string scene = replaced_once(stress_scene("incompressible", "stable_neo_hookean"),
                                          "[16, 4, 4]", "[8, 2, 2]");
  const auto deflection = [&](const char* element) {
    const nlohmann::json json = run_stress(replaced_once(scene, "hexa20-q8", element));
    return -json["probes"][0]["displacement"][2].get<double>() / 0.380;
  };
  EXPECT_GT(deflection("hexa20-q8"), 0.92);
  EXPECT_GT(deflection("tet10-q4"), 0.88);
  EXPECT_LT(deflection("hexa8-q8"), 0.2);
  EXPECT_LT(deflection("tet4-q1"), 0.2);
}

TEST_F(Stress, ProjectedTangentsFindTheShapeAtRestInFewerSteps) {
  for (const char* name : {"inverted", "flattened"}) {
    const std::string scene = stress_scene(name, "stable_neo_hookean");
    const int shifted = run_stress(scene)["solver"]["newton_iterations"];
    const nlohmann::json projected =
        run_stress(replaced_once(scene, "[solver]", "[solver]\nproject = \"on_demand\""))["solver"];
    EXPECT_LT(projected["newton_iterations"], shifted / 2) << name;
    EXPECT_GT(projected["projections"], 0) << name;
    EXPECT_LT(projected["energy"], 1e-4) << name;
  }
}

TEST_F(Stress, ImplicitStepsOfAnyLengthStayBounded) {
  const std::string scene = stress_scene("long_steps", "neo_hookean");
  for (const char* step : {"1e-6", "1e-3", "0.1", "1.0"}) {
    const std::string text =
        replaced_once(replaced_once(scene, "step = 1.0", std::string("step = ") + step),
                      "end = 20.0", fmt::format("end = {:.9f}", 20 * std::stod(step)));
    const nlohmann::json json = run_stress(text);
    EXPECT_EQ(json["motion"]["steps"], 20) << step;
    EXPECT_LT(std::abs(json["probes"][0]["displacement"][2].get<double>()), 4) << step;
  }
}

}  // namespace
}  // namespace elastogen::selector
