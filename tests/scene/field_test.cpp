// Stress in results: right values, in every file that shows them.
#include <algorithm>
#include <cmath>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

/// A cube of neo-Hooke (E = 1 MPa, nu = 0.3), stretched to 1.6 along x with free sides.
const std::string stretched_cube = R"([bar]
length = 1.0
width = 1.0
height = 1.0
cells = [1, 1, 1]
[[bar.section]]
until = 1.0
association = "neo_hookean-tet4-q1-none"
region = "cube"
[material.cube]
density = 1000
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x"]
[[constraint]]
plane = { y = 0.0 }
fixed = ["y"]
[[constraint]]
plane = { z = 0.0 }
fixed = ["z"]
[[constraint]]
plane = { x = 1.0 }
displacement = { x = 0.6 }
[[probe]]
name = "end"
plane = { x = 1.0 }
)";

using Fields = Run;

std::string vtu_header(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, "result");
  return text.substr(0, text.find("<AppendedData"));
}

bool has_array(const std::string& header, const std::string& name) {
  return header.find("Name=\"" + name + "\"") != std::string::npos;
}

TEST_F(Fields, OfAStretchedCubeAreThoseOfTheClosedForm) {
  const ProcessResult result = run_scene(write(
      stretched_cube +
      "[solver]\ntolerance = 1e-12\n[output]\nwrite = [\"vtu\"]\nstress_at = [\"elements\", "
      "\"nodes\", \"points\"]\nnodal = "
      "[\"projection\", \"average\"]\nfields = [\"first_piola_kirchhoff_stress\", "
      "\"second_piola_kirchhoff_stress\", \"cauchy_stress\", \"volume_ratio\", \"von_mises\", "
      "\"principal_stress\", \"principal_directions\", \"green_lagrange_strain\", "
      "\"logarithmic_strain\", \"energy_density\", \"displacement\"]\n"));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json probe = summary()["probes"][0], fields = probe["fields"];
  // P from a root finder for mu (1 - 1/s^2) + lambda ln J / s^2 = 0 across, s the stretch there.
  const double p = 436971.2, across = 1 + probe["displacement"][1].get<double>() * 2;
  const double exact = 1e-7 * p;  // the digits that are known of P
  EXPECT_NEAR(fields["first_piola_kirchhoff_stress"]["XX"], p, 0.05);
  EXPECT_NEAR(fields["first_piola_kirchhoff_stress"]["YY"], 0, exact);
  EXPECT_NEAR(fields["cauchy_stress"]["XX"], p / (across * across), exact / (across * across));
  EXPECT_NEAR(fields["von_mises"], p / (across * across), exact / (across * across));
  EXPECT_NEAR(fields["second_piola_kirchhoff_stress"]["XX"], p / 1.6, exact);
  EXPECT_NEAR(fields["volume_ratio"], 1.6 * across * across, 1e-9);
  EXPECT_NEAR(fields["green_lagrange_strain"]["XX"], (1.6 * 1.6 - 1) / 2, 1e-9);
  EXPECT_NEAR(fields["logarithmic_strain"]["XX"], std::log(1.6), 1e-9);
  EXPECT_NEAR(fields["principal_stress"]["1"], fields["cauchy_stress"]["XX"], 1e-9 * p);
  EXPECT_NEAR(fields["principal_direction_1"]["X"], 1, 1e-9);
  EXPECT_NEAR(summary()["greatest_von_mises"]["value"], p / (across * across), 1e-6 * p);
  EXPECT_NEAR(probe["reaction"][0], p, 0.05);

  const std::string header = vtu_header(out() / "result.vtu");
  for (const char* name : {"cauchy_stress", "cauchy_stress_average", "cauchy_stress_projection",
                           "principal_direction_2", "von_mises_average", "displacement"}) {
    EXPECT_TRUE(has_array(header, name)) << name;
  }
  EXPECT_FALSE(has_array(header, "reactions"));
  const std::string points = vtu_header(out() / "points.vtu");
  EXPECT_NE(points.find("NumberOfPoints=\"6\""), std::string::npos);
  for (const char* name : {"element", "displacement", "first_piola_kirchhoff_stress"}) {
    EXPECT_TRUE(has_array(points, name)) << name;
  }
}

// In the mean of an element as thick as the bar, bending cancels.
TEST_F(Fields, GreatestVonMisesIsThatOfPointsAndLeavesNothingOfEarlierRuns) {
  const std::string bar = R"([bar]
length = 10.0
width = 1.0
height = 1.0
cells = [20, 1, 1]
[[bar.section]]
until = 1.0
association = "stvk-hexa8-q8-none"
region = "bar"
[material.bar]
density = 1000
young = 1e9
poisson = 0.0
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
[[load]]
plane = { x = 10.0 }
force = [0.0, 0.0, -1000.0]
[output]
write = ["vtu"]
)";
  ProcessResult result = run_scene(write(bar + "stress_at = [\"elements\", \"points\"]\n"));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_TRUE(std::filesystem::exists(out() / "points.vtu"));
  // M c / I = 6 F L / h^3 at the clamp's surface; linear elements have it at their middle, points
  // at 1 / sqrt(3) of the way to the surface.
  const nlohmann::json greatest = summary()["greatest_von_mises"];
  EXPECT_NEAR(greatest["value"], 60000 * (1 - 0.25 / 10) / std::sqrt(3.0), 3000);
  EXPECT_EQ(greatest["element"], 0);
  EXPECT_NE(result.output.find("kPa at quadrature points, in element 0"), std::string::npos)
      << result.output;
  write_text_file(out() / "stress.png", "of an earlier run");
  result = run_scene(write(bar));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_FALSE(std::filesystem::exists(out() / "points.vtu"));
  EXPECT_FALSE(std::filesystem::exists(out() / "stress.png"));
}

TEST_F(Fields, AreLeftOutWithTheirKernelWhereNoneIsAsked) {
  const ProcessResult result =
      run_scene(write(stretched_cube + "[output]\nfields = []\nwrite = [\"vtu\"]\n"));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json skipped = summary()["skipped_operations"];
  EXPECT_NE(std::find(skipped.begin(), skipped.end(), "stress"), skipped.end());
  EXPECT_FALSE(summary()["probes"][0].contains("fields"));
  EXPECT_FALSE(has_array(vtu_header(out() / "result.vtu"), "displacement"));
}

// Lame: sigma_rr = -p and sigma_tt = p (a^3 + b^3 / 2) / (b^3 - a^3) inside.
TEST_F(Fields, OfAThickSphereNearLamesSolution) {
  const std::string scene = read_text_file(shipped("thick_sphere"), "scene");
  const auto error_with = [&](const std::string& cells, const std::string& nodal) {
    const ProcessResult result =
        run_scene(write(replaced_once(scene, "cells = [6, 6]", "cells = " + cells) +
                        "[output]\nwrite = [\"vtu\"]\nfields = [\"cauchy_stress\"]\nnodal = [\"" +
                        nodal + "\"]\n"));
    EXPECT_EQ(result.exit_status, 0) << result.output;
    const nlohmann::json stress = summary()["probes"][0]["fields"]["cauchy_stress"];
    const double p = 1e4, radial = -p, around = p * 5 / 7;
    return std::hypot(stress["XX"].get<double>() - radial, stress["YY"].get<double>() - around,
                      stress["ZZ"].get<double>() - around) /
           p;
  };
  for (const std::string nodal : {"average", "projection"}) {
    const double coarse = error_with("[3, 4]", nodal), fine = error_with("[6, 8]", nodal);
    RecordProperty(nodal, std::to_string(fine));
    // On a surface nodes of linear elements are of first order.
    EXPECT_LT(fine, 0.3) << nodal;
    EXPECT_GT(coarse / fine, 1.8) << nodal << ": " << coarse << " -> " << fine;
  }
}

TEST_F(Fields, OfMotionsAreInTheSeriesAndTheHistory) {
  const ProcessResult result = run_scene(write(
      "gravity = [0, 0, -9.81]\n" +
      replaced_once(stretched_cube, "displacement = { x = 0.6 }", "fixed = [\"x\"]") +
      "[solver]\nprecision = \"single\"\n[dynamics]\nscheme = \"central_differences\"\nend = 0.05\n"
      "[output]\nwrite = [\"series\", \"history\", \"picture\"]\nevery = 1000\nfields = "
      "[\"von_mises\", \"cauchy_stress\"]\nstress_at = [\"nodes\", \"points\"]\n"));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const std::string history = read_text_file(out() / "history.csv", "history");
  EXPECT_NE(history.find(",end_von_mises\n"), std::string::npos) << history.substr(0, 300);
  EXPECT_NE(history.find("end_cauchy_stress_XX,"), std::string::npos);
  for (const char* file :
       {"series.pvd", "points.pvd", "series/step_000000.vtu", "series/points_000000.vtu"}) {
    EXPECT_TRUE(std::filesystem::exists(out() / file)) << file;
  }
  const nlohmann::json fields = summary()["probes"][0]["fields"];
  EXPECT_GT(fields["von_mises"].get<double>(), 100);  // its weight is of the order of 1e4 Pa
}

}  // namespace
}  // namespace elastogen::selector
