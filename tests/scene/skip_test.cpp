// What a run leaves out, by the built program: counted in the summary, and missed nowhere.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

class Skip : public Run {
 protected:
  /// Runs the scene with other settings of [skip], which follow it.
  [[nodiscard]] nlohmann::json run_with(const std::string& scene, const std::string& skip) const {
    const ProcessResult result = run_scene(write(scene + "\n[skip]\n" + skip));
    EXPECT_EQ(result.exit_status, 0) << result.output;
    output_ = result.output;
    return summary();
  }
  mutable std::string output_;
};

/// A bar whose near half is held.
const std::string half_held_bar = R"(gravity = [0, 0, -9.81]
[bar]
length = 2.0
width = 0.5
height = 0.5
cells = [8, 2, 2]
[[bar.section]]
until = 1.0
association = "stvk-hexa8-q8-none"
region = "body"
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
box = { min = [0, 0, 0], max = [1, 1, 1] }
fixed = ["x", "y", "z"]
[[probe]]
name = "held"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[output]
write = []
[solver]
method = )";

class RestingElements : public Skip, public testing::WithParamInterface<const char*> {};

TEST_P(RestingElements, ChangeNothing) {
  const std::string scene = half_held_bar + '"' + GetParam() + '"';
  const nlohmann::json skipping = run_with(scene, "");
  EXPECT_NE(output_.find("16 elements at rest between held nodes"), std::string::npos) << output_;
  const nlohmann::json whole = run_with(scene, "at_rest = false");
  EXPECT_EQ(skipping["skipped"]["elements_at_rest"], 16);
  EXPECT_EQ(whole["skipped"]["elements_at_rest"], 0);
  // What is left out sums to zeros. Sums in another order may need a last iteration more or less.
  EXPECT_NEAR(skipping["solver"]["newton_iterations"].get<int>(),
              whole["solver"]["newton_iterations"].get<int>(), 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(skipping["tip_displacement"][c], whole["tip_displacement"][c], 1e-9) << c;
    EXPECT_NEAR(skipping["probes"][0]["reaction"][c], whole["probes"][0]["reaction"][c], 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, RestingElements,
                         testing::Values("cg", "cholesky", "cholesky_cg", "incomplete_cg"));

/// A strip of which one end is shaken; the wave comes to a part of it.
const std::string shaken_strip = R"([bar]
length = 4.0
width = 0.2
height = 0.2
cells = [80, 4, 4]
[[bar.section]]
until = 1.0
association = "stvk-tet4-q1-none"
region = "strip"
[material.strip]
density = 1100.0
young = 2e5
poisson = 0.4
[[constraint]]
plane = { x = 4.0 }
fixed = ["x", "y", "z"]
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "z"]
displacement = { y = 0.02 }
sine = 4.0
[[probe]]
name = "near"
plane = { x = 0.5 }
[dynamics]
scheme = "central_differences"
step = 1e-3
end = 0.15
damping = 2.0
[output]
write = []
)";

TEST_F(Skip, SleepingRegionsKeepTheirForcesUntilTheWaveComes) {
  const nlohmann::json awake = run_with(shaken_strip, "");
  const nlohmann::json asleep = run_with(shaken_strip, "sleep = { motion = 1e-7, steps = 5 }");
  EXPECT_EQ(awake["skipped"]["forces_kept"], 0);
  const double kept = asleep["skipped"]["forces_kept"];
  const double all = asleep["skipped"]["element_passes"];
  EXPECT_GT(kept, 0.1 * all);
  EXPECT_LT(kept, 0.9 * all);
  EXPECT_NE(output_.find("forces of sleeping elements"), std::string::npos) << output_;
  // By power iteration on differences of forces over 1e-6 of an element: the forces' rounding is
  // some 1e-10 of what they differ by, and how it falls depends on the order of summation, which
  // follows from the width of vectors.
  const double step = awake["motion"]["critical_step"];
  EXPECT_NEAR(asleep["motion"]["critical_step"].get<double>(), step, 1e-9 * step);
  const double moved = awake["probes"][0]["displacement"][1];
  EXPECT_GT(std::abs(moved), 1e-3);
  EXPECT_NEAR(asleep["probes"][0]["displacement"][1], moved, 1e-6);
}

}  // namespace
}  // namespace elastogen::selector
