// Motions in time and load steps by the built program: rest, records, kills and resuming.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

/// A clamped bar, falling; the keys of [dynamics] follow the text.
const std::string falling_bar = R"(gravity = [0, 0, -9.81]
[bar]
length = 2.0
width = 0.5
height = 0.5
cells = [4, 2, 2]
[[bar.section]]
until = 0.5
association = "stvk-prism6-q6-none"
region = "body"
[[bar.section]]
until = 1.0
association = "neo_hookean-hexa8-q8-none"
region = "body"
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
[[probe]]
name = "clamp"
plane = { x = 0.0 }
[[probe]]
name = "tip"
plane = { x = 2.0 }
)";

/// A bar whose end turns by a quarter in four load steps.
const std::string twisted_bar = R"([bar]
length = 2.0
width = 1.0
height = 1.0
cells = [4, 2, 2]
[[bar.section]]
until = 1.0
association = "stvk-hexa8-q8-none"
region = "body"
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
[[constraint]]
plane = { x = 2.0 }
rotation = { point = [2, 0.5, 0.5], axis = [1, 0, 0], turns = 0.25 }
[[probe]]
name = "turned"
plane = { x = 2.0 }
[output]
write = ["vtu", "series", "history"]
)";

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

class Steps : public Run {
 protected:
  void expect_run(const std::string& text, const std::vector<std::string>& more = {},
                  int status = 0) const {
    const ProcessResult result = run_scene(write(text), more);
    ASSERT_EQ(result.exit_status, status) << result.output;
  }

  /// Every result file by its name, without those that hold times or the state itself.
  [[nodiscard]] std::map<std::string, std::string> results() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out())) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".vtu" && extension != ".csv" && extension != ".pvd") continue;
      const std::string name = std::filesystem::relative(entry.path(), out()).string();
      files[name] = read_text_file(entry.path(), "result");
    }
    return files;
  }

  [[nodiscard]] std::vector<std::string> history_lines() const {
    std::istringstream text(read_text_file(out() / "history.csv", "history"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

TEST_F(Steps, FallingBeamComesToRestWhereStaticsFindsIt) {
  ASSERT_EQ(run_scene(shipped("mixed_beam"), {"--cells", "16x2x2"}).exit_status, 0);
  const nlohmann::json still = summary();
  const ProcessResult result = run_scene(shipped("mixed_beam_falling"), {"--cells", "16x2x2"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json fallen = summary();
  EXPECT_EQ(fallen["motion"]["status"], "at rest");
  EXPECT_LT(fallen["motion"]["time"], 30.0);
  EXPECT_LT(fallen["motion"]["kinetic_energy"], 1e-9 * fallen["mesh"]["nodes"].get<double>());
  EXPECT_EQ(fallen["skipped_operations"],
            nlohmann::json::parse(R"(["energy", "linearize", "apply"])"));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(fallen["tip_displacement"][c], still["tip_displacement"][c], 1e-5) << c;
  }
  EXPECT_NEAR(fallen["probes"][0]["reaction"][2], 78480, 1);
  for (const char* file : {"series.pvd", "series/step_000010.vtu", "history.csv", "history.png",
                           "deflection.png", "deformed.png"}) {
    EXPECT_TRUE(std::filesystem::exists(out() / file)) << file;
  }
}

TEST_F(Steps, KilledAnywhereAndResumedGivesTheSameFiles) {
  const std::vector<std::string> cells = {"--cells", "16x2x2"};
  ASSERT_EQ(run_scene(shipped("mixed_beam_falling"), cells).exit_status, 0);
  const auto expected = results();
  ASSERT_GT(expected.size(), 20U);
  std::filesystem::remove_all(out());

  int kills = 0;
  for (double seconds = 0.1; seconds < 20; seconds *= 1.3) {
    std::vector<std::string> command = {
        "timeout",       "-s",      "KILL",  fmt::format("{:.3f}", seconds),         "env",
        cache_setting(), program(), "run",   shipped("mixed_beam_falling").string(), "--out",
        out().string(),  cells[0],  cells[1]};
    if (std::filesystem::exists(out() / "state.cbor")) command.emplace_back("--resume");
    const ProcessResult result = run_process(command);
    if (result.signal == 0 && result.exit_status == 0) break;
    ASSERT_TRUE(result.signal != 0 || result.exit_status == 137) << result.output;
    if (!std::filesystem::exists(out())) continue;
    ++kills;
    for (const auto& [name, text] : results()) {
      if (name.ends_with(".csv")) {
        EXPECT_TRUE(text.empty() || text.ends_with('\n')) << name;
      } else {
        EXPECT_TRUE(text.ends_with("</VTKFile>\n")) << name;
      }
    }
  }
  EXPECT_GT(kills, 1);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out())) {
    const std::string name = entry.path().filename().string();
    EXPECT_FALSE(name.starts_with('.')) << name << " of a killed run is left";
  }
  EXPECT_GT(summary()["resumed_from"]["step"], 0);
  const auto found = results();
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, text] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name) == text) << name << " differs";
  }
}

class Scheme : public Steps, public testing::WithParamInterface<const char*> {};

TEST_P(Scheme, GoesOnPastItsEndAsIfItHadNotEnded) {
  // To the bit with methods that keep no factor from step to step.
  const std::string solver =
      std::string_view(GetParam()) == "implicit_euler" ? "[solver]\nmethod = \"cg\"\n" : "";
  const auto scene = [&](const char* end) {
    return fmt::format(
        "{}{}[dynamics]\nscheme = \"{}\"\nstep = 0.002\nend = {}\ndamping = 1.0\n"
        "[output]\nwrite = [\"vtu\", \"series\", \"history\"]\nevery = 5\n",
        falling_bar, solver, GetParam(), end);
  };
  expect_run(scene("0.1"));
  EXPECT_EQ(summary()["motion"]["status"], "end of time");
  EXPECT_EQ(summary()["motion"]["steps"], 50);
  const auto expected = results();
  EXPECT_EQ(history_lines().size(), 1U + 51U);
  std::filesystem::remove_all(out());
  expect_run(scene("0.034"));
  expect_run(scene("0.1"), {"--resume"});
  EXPECT_EQ(summary()["resumed_from"]["step"], 17);
  EXPECT_EQ(summary()["motion"]["steps_made"], 33);
  EXPECT_EQ(results(), expected);
}

INSTANTIATE_TEST_SUITE_P(All, Scheme,
                         testing::Values("implicit_euler", "symplectic_euler",
                                         "central_differences"));

TEST_F(Steps, ExplicitRunHasNoTangentAndNoEnergyUnlessAsked) {
  const std::string scene = falling_bar +
                            "[dynamics]\nscheme = \"central_differences\"\nend = 0.02\n"
                            "[output]\nwrite = [\"history\"]\n";
  expect_run(scene);
  nlohmann::json json = summary();
  EXPECT_EQ(json["operations"], nlohmann::json::parse(R"(["forces"])"));
  EXPECT_NEAR(json["motion"]["step"], 0.9 * json["motion"]["critical_step"].get<double>(), 1e-12);
  EXPECT_EQ(history_lines()[0].find("elastic_energy"), std::string::npos);
  expect_run(scene + "energy = true\n");
  EXPECT_EQ(summary()["operations"], nlohmann::json::parse(R"(["energy", "forces"])"));
  EXPECT_NE(history_lines()[0].find("elastic_energy"), std::string::npos);
}

TEST_F(Steps, EnergiesAreTheWorkOfTheLoad) {
  const std::string scene = replaced_once(falling_bar, "gravity = [0, 0, -9.81]\n", "");
  expect_run(scene +
             "[dynamics]\nscheme = \"central_differences\"\nstep = 0.001\nend = 0.3\n"
             "[[load]]\nplane = { x = 2.0 }\nforce = [0, 0, -100]\n"
             "[output]\nwrite = [\"history\"]\nenergy = true\n");
  const std::vector<std::string> lines = history_lines();
  const std::vector<std::string> names = fields_of(lines[0]);
  const auto tip = std::find(names.begin(), names.end(), "tip_uz") - names.begin();
  double largest = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fields_of(lines[i]);
    const double kinetic = std::stod(fields[2]), elastic = std::stod(fields[3]);
    const double work = -100 * std::stod(fields[static_cast<std::size_t>(tip)]);
    largest = std::max(largest, work);
    EXPECT_NEAR(kinetic + elastic, work, 5e-3 * largest + 1e-6) << lines[i];
  }
  EXPECT_GT(largest, 0.5);
}

TEST_F(Steps, UnstableStepIsRefusedBeforeAnythingIsWritten) {
  const ProcessResult result = run_scene(
      write(falling_bar + "[dynamics]\nscheme = \"symplectic_euler\"\nstep = 0.1\nend = 1\n"));
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("scene.toml:30: dynamics.step = 0.1: symplectic_euler is unstable"),
            std::string::npos)
      << result.output;
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(Steps, EndAtTheNextStepOnCtrlC) {
  const std::string scene =
      falling_bar + "[dynamics]\nscheme = \"central_differences\"\nstep = 1e-6\nend = 100\n";
  // Not before its first checkpoint: kernels may have to be compiled first.
  const std::string script =
      "\"$1\" run \"$2\" --out \"$3\" 2>&1 & pid=$!\n"
      "until [ -e \"$3/state.cbor\" ] || ! kill -0 $pid; do sleep 0.02; done\n"
      "kill -INT $pid; wait $pid";
  const ProcessResult result = run_process({"env", cache_setting(), "sh", "-c", script, "sh",
                                            program(), write(scene).string(), out().string()});
  EXPECT_EQ(result.exit_status, 130) << result.output;
  EXPECT_EQ(summary()["motion"]["status"], "interrupted");
  EXPECT_TRUE(std::filesystem::exists(out() / "result.vtu"));
  EXPECT_NE(result.output.find("--resume goes on from there"), std::string::npos);
}

TEST_F(Steps, FailedStepKeepsWhatWasReached) {
  // Pushed together so far that neo-Hooke elements turn inside out.
  const std::string pulled =
      replaced_once(falling_bar, "[[probe]]",
                    "[[constraint]]\nplane = { x = 2.0 }\ndisplacement = { x = -4.0 }\n"
                    "history = [[0, 0], [0.05, 0], [0.1, 1]]\n[[probe]]");
  const ProcessResult result = run_scene(write(
      pulled +
      "[dynamics]\nscheme = \"central_differences\"\nend = 1\n[output]\nwrite = [\"vtu\"]\n"));
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_NE(result.output.find("element "), std::string::npos) << result.output;
  EXPECT_EQ(summary()["motion"]["status"], "failed");
  EXPECT_GT(summary()["motion"]["steps"], 5);
  EXPECT_TRUE(std::filesystem::exists(out() / "result.vtu"));
}

TEST_F(Steps, PrescribedMotionFollowsItsHistory) {
  const std::string moved = replaced_once(
      falling_bar, "[[probe]]",
      "[[constraint]]\nplane = { x = 2.0 }\ndisplacement = { x = 0.1 }\nsine = 2.5\n[[probe]]");
  expect_run(moved + "[dynamics]\nscheme = \"implicit_euler\"\nstep = 0.01\nend = 0.1\n");
  EXPECT_NEAR(summary()["probes"][1]["displacement"][0], 0.1, 1e-15);  // a quarter period
}

// The first breath of the shipped scene: the tumour goes along and hardly changes its shape, and
// every method comes to the same.
TEST_F(Steps, TissueBreathesAroundATumour) {
  const std::string scene =
      replaced_once(read_text_file(shipped("respiration"), "scene"), "end = 9.0", "end = 1.0");
  std::vector<std::array<double, 3>> places;
  for (const std::string method : {"cholesky_cg", "incomplete_cg", "cg"}) {
    expect_run(replaced_once(scene, "cholesky_cg", method));
    const nlohmann::json found = summary();
    EXPECT_EQ(found["mesh"]["elements"], 2760);
    EXPECT_NEAR(found["probes"][1]["displacement"][0], 0.015, 1e-12);  // a quarter period
    places.push_back(found["probes"][0]["displacement"]);
    EXPECT_GT(places.back()[0], 0.003);
    EXPECT_LT(places.back()[0], 0.012);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(places.back()[i], places.front()[i], 1e-6 * places.front()[0]) << method;
    }
    std::filesystem::remove_all(out());
  }
}

TEST_F(Steps, LoadStepsGoOnToTheSameFiles) {
  // The first half turns so little that its steps take fewer iterations than the limit allows.
  const std::string bar =
      replaced_once(twisted_bar, "turns = 0.25 }",
                    "turns = 0.25 }\nhistory = [[0.0, 0.0], [0.5, 1e-6], [1.0, 1.0]]");
  for (const std::string method : {"cg", "cholesky_cg", "incomplete_cg"}) {
    const std::string steps =
        fmt::format("[solver]\nmethod = \"{}\"\nload_steps = 4\nmax_iterations = ", method);
    expect_run(bar + steps + "100\n");
    const nlohmann::json whole = summary();
    const auto expected = results();
    EXPECT_TRUE(expected.contains("series/step_000004.vtu"));
    EXPECT_EQ(history_lines().size(), 1U + 5U);
    const int iterations = whole["solver"]["newton_iterations"];
    std::filesystem::remove_all(out());

    expect_run(bar + steps + "4\n", {}, 1);
    expect_run(bar + steps + "100\n", {"--resume"});
    EXPECT_EQ(summary()["resumed_from"]["step"], 2);
    EXPECT_EQ(summary()["solver"]["newton_iterations"], iterations);
    EXPECT_EQ(results(), expected) << method;
    std::filesystem::remove_all(out());
  }
}

TEST_F(Steps, ResumingWithoutTheEarlierFactorSaysSo) {
  const auto scene = [](const char* end) {
    return falling_bar + "[solver]\nmethod = \"cholesky_cg\"\n[dynamics]\n" +
           "scheme = \"implicit_euler\"\nstep = 0.01\nend = " + end + "\n";
  };
  expect_run(scene("0.1"));
  const double whole = summary()["probes"][1]["displacement"][2];
  std::filesystem::remove_all(out());
  expect_run(scene("0.05"));
  expect_run(scene("0.1"), {"--resume"});
  EXPECT_NE(summary()["warnings"].dump().find("cholesky_cg"), std::string::npos);
  EXPECT_NEAR(summary()["probes"][1]["displacement"][2], whole, 1e-6 * std::abs(whole));
}

TEST_F(Steps, TwistNeedsAMoment) {
  expect_run(twisted_bar + "[solver]\nload_steps = 4\n");
  const nlohmann::json probe = summary()["probes"][0];
  // Saint-Venant: M = G J theta / L with J = 0.141 b^4, and more as the twist is large.
  const double estimate = 1e6 / 2.6 * 0.141 * (M_PI / 2) / 2;
  EXPECT_NEAR(probe["moment"][0], estimate, 0.5 * estimate);
  EXPECT_NEAR(probe["moment"][1], 0, 1e-3 * estimate);
}

TEST_F(Steps, ResumingRefusesAnotherProblem) {
  const std::string dynamics = "[dynamics]\nscheme = \"implicit_euler\"\nstep = 0.01\nend = 0.05\n";
  expect_run(falling_bar + dynamics + "[output]\nwrite = []\n");
  ProcessResult result =
      run_scene(write(replaced_once(falling_bar, "poisson = 0.3", "poisson = 0.31") + dynamics),
                {"--resume"});
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("is of another problem"), std::string::npos) << result.output;
  result = run_scene(write("title = \"A new name\"\n" + falling_bar + dynamics), {"--resume"});
  EXPECT_EQ(result.exit_status, 0) << result.output;
}

TEST_F(Steps, ResumingKeepsTheColumnsAndListsFilesOfPointsThatThereAre) {
  const auto scene = [](const std::string& end, const std::string& output) {
    return falling_bar + "[dynamics]\nscheme = \"implicit_euler\"\nstep = 0.01\nend = " + end +
           "\n[output]\nwrite = [\"history\", \"series\"]\nevery = 1\n" + output;
  };
  expect_run(scene("0.02", ""));
  const std::string history = read_text_file(out() / "history.csv", "history");
  const ProcessResult other = run_scene(write(scene("0.04", "momentum = true\n")), {"--resume"});
  EXPECT_EQ(other.exit_status, 2);
  EXPECT_NE(other.output.find("the scene now asks for 'step,time,kinetic_energy,momentum_x"),
            std::string::npos)
      << other.output;
  EXPECT_EQ(read_text_file(out() / "history.csv", "history"), history);
  const ProcessResult points = run_scene(
      write(scene("0.04", "stress_at = [\"elements\", \"nodes\", \"points\"]\n")), {"--resume"});
  EXPECT_EQ(points.exit_status, 0) << points.output;
  const std::string index = read_text_file(out() / "points.pvd", "index");
  EXPECT_EQ(index.find("points_000002"), std::string::npos);
  EXPECT_NE(index.find("points_000003"), std::string::npos);
}

TEST_F(Steps, ResumingNeedsACheckpoint) {
  const std::string dynamics = "[dynamics]\nscheme = \"implicit_euler\"\nstep = 0.01\nend = 0.05\n";
  ProcessResult result = run_scene(write(falling_bar + dynamics), {"--resume"});
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("start without it"), std::string::npos) << result.output;
  EXPECT_FALSE(std::filesystem::exists(out()));
  result = run_scene(write(falling_bar), {"--resume"});
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("has no steps to go on from"), std::string::npos) << result.output;
  std::filesystem::create_directory(out());
  write_text_file(out() / "state.cbor", "not a checkpoint");
  result = run_scene(write(falling_bar + dynamics), {"--resume"});
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("this is no checkpoint"), std::string::npos) << result.output;
}

TEST_F(Run, TractionGivesBackTheModuli) {
  const ProcessResult result = run_scene(shipped("traction"), {"--cells", "16x2x2"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json measured = summary()["measured"];
  // Exact are P / (F - 1) = E F (F + 1) / 2, and the lateral stretch sqrt(1 - nu (F^2 - 1)).
  const double stretch = 1 + measured["strain"].get<double>();
  EXPECT_NEAR(stretch, 1.0001, 1e-12);
  EXPECT_NEAR(measured["young"], 1e6 * stretch * (stretch + 1) / 2, 1);
  const double lateral = std::sqrt(1 - 0.3 * (stretch * stretch - 1)) - 1;
  EXPECT_NEAR(measured["poisson"], -lateral / (stretch - 1), 1e-6);
}

TEST_F(Run, TorsionOfTheMixedBeamComesNearARefinedOne) {
  std::string text = read_text_file(shipped("mixed_beam_torsion"), "scene");
  const std::string mixed = text;
  for (const char* other : {"stvk-prism6-q6", "stvk-pyramid5-q5", "stvk-tet4-q1"}) {
    text = replaced_once(text, other, "stvk-hexa8-q8");
  }
  const ProcessResult fine = run_scene(write(text), {"--cells", "32x6x6"});
  ASSERT_EQ(fine.exit_status, 0) << fine.output;
  const std::filesystem::path reference = out().parent_path() / "fine.vtu";
  std::filesystem::copy_file(out() / "result.vtu", reference);
  const std::string compared =
      mixed + fmt::format("[reference]\nfile = \"{}\"\n", reference.string());
  double before = 1;
  for (const char* cells : {"16x3x3", "32x6x6"}) {
    const ProcessResult result = run_scene(write(compared), {"--cells", cells});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const nlohmann::json distance = summary()["reference"];
    EXPECT_LT(distance["mean_distance"], 0.6 * before);
    EXPECT_LE(distance["mean_distance"], distance["max_distance"]);
    before = distance["mean_distance"];
  }
  EXPECT_LT(before, 0.02);  // the thesis: 0.04 m, table 6.7
}

}  // namespace
}  // namespace elastogen::selector
