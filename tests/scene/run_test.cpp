// Whole runs by the built program: kernels made on the spot, results as the files say them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

TEST_F(Run, MixedBeamComesNearTheConvergedCurve) {
  const ProcessResult result = run_scene(shipped("mixed_beam"));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_NE(result.output.find("warning: 25 quadrilateral faces meet triangles"), std::string::npos)
      << result.output;
  for (const char* file : {"result.vtu", "deflection.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(out() / file)) << file;
  }
  const nlohmann::json json = summary();
  EXPECT_EQ(json["solver"]["status"], "converged");
  EXPECT_EQ(json["mesh"]["elements"], 3000);
  EXPECT_EQ(json["associations"].size(), 4U);
  EXPECT_LT(json["reference"]["mean_distance_uz"], 0.01);
  // The clamp carries the weight of 8 m^3, to the solver's tolerance.
  const double weight = 1000 * 8 * 9.81;
  EXPECT_NEAR(json["probes"][0]["reaction"][2], weight, 1e-7 * weight);
  EXPECT_NEAR(json["probes"][1]["displacement"][2], json["tip_displacement"][2], 1e-14);
}

TEST_F(Run, HookeOnThePrismsChangesLittle) {
  const ProcessResult result = run_scene(shipped("mixed_beam_hooke_prisms"));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_LT(summary()["reference"]["mean_distance_uz"], 0.01);
}

struct KnownTip {
  const char* scene;
  const char* cells;
  double ux, uz;  ///< of FEniCSx 0.5 on the same mesh [m]
};

void PrintTo(const KnownTip& tip, std::ostream* out) { *out << tip.scene << ' ' << tip.cells; }

class PureBeam : public Run, public testing::WithParamInterface<KnownTip> {};

TEST_P(PureBeam, AgreesWithAnotherSolverOnTheSameMesh) {
  const KnownTip& known = GetParam();
  const ProcessResult result = run_scene(shipped(known.scene), {"--cells", known.cells});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json tip = summary()["tip_displacement"];
  EXPECT_NEAR(tip[0], known.ux, 1e-6);
  EXPECT_NEAR(tip[2], known.uz, 2e-6);
}

INSTANTIATE_TEST_SUITE_P(All, PureBeam,
                         testing::Values(KnownTip{"beam_hexa8", "24x4x4", -0.023634, -0.575799},
                                         KnownTip{"beam_hexa8", "48x8x8", -0.025606, -0.599316},
                                         KnownTip{"beam_tet4", "48x8x8", -0.022921, -0.567049}));

class ConvergingBeam : public Run, public testing::WithParamInterface<const char*> {};

TEST_P(ConvergingBeam, GetsNearerWithMoreCells) {
  double before = 1;
  for (const char* cells : {"16x2x2", "32x4x4"}) {
    const ProcessResult result = run_scene(shipped(GetParam()), {"--cells", cells});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const double distance = summary()["reference"]["mean_distance_uz"];
    EXPECT_LT(distance, 0.5 * before) << cells;
    before = distance;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ConvergingBeam,
                         testing::Values("mixed_beam", "beam_prism6", "beam_pyramid5"));

/// A bar that is pulled: StVK, nu = 0, so that the force follows from the stretch by hand.
const std::string pulled_bar = R"([bar]
length = 2.0
width = 1.0
height = 1.0
cells = [4, 2, 2]
[[bar.section]]
until = 0.5
association = "stvk-pyramid5-q5-none"
region = "body"
[[bar.section]]
until = 1.0
association = "stvk-hexa8-q8-none"
region = "body"
[material.body]
density = 1000.0
young = 1e6
poisson = 0.0
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
[[constraint]]
plane = { x = 2.0 }
displacement = { x = 0.2 }
[[probe]]
name = "wall"
plane = { x = 0.0 }
[[probe]]
name = "grip"
plane = { x = 2.0 }
)";

class Method : public Run, public testing::WithParamInterface<const char*> {};

TEST_P(Method, GivesTheReactionToAPrescribedStretchByHand) {
  const std::string solver = std::string("[solver]\nmethod = \"") + GetParam() + "\"\n";
  const ProcessResult result = run_scene(write(pulled_bar + solver));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(summary()["solver"]["method"], GetParam());
  const nlohmann::json probes = summary()["probes"];
  // F = 1.1: first Piola-Kirchhoff stress P = F E (F^2 - 1) / 2, on 1 m^2.
  const double force = 1.1 * 1e6 * (1.1 * 1.1 - 1) / 2;
  EXPECT_NEAR(probes[0]["reaction"][0], -force, 1e-6 * force);
  EXPECT_NEAR(probes[1]["reaction"][0], force, 1e-6 * force);
  EXPECT_NEAR(probes[1]["displacement"][0], 0.2, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(All, Method,
                         testing::Values("cg", "cholesky", "cholesky_cg", "incomplete_cg"));

class Tangent : public Run, public testing::WithParamInterface<const char*> {};

TEST_P(Tangent, GivesTheSameByEveryKindOfProduct) {
  const double force = 1.1 * 1e6 * (1.1 * 1.1 - 1) / 2;
  for (const std::string precision : {"double", "mixed"}) {
    SCOPED_TRACE(precision);
    const ProcessResult result =
        run_scene(write(pulled_bar + "[solver]\nmethod = \"cg\"\ntangent = \"" + GetParam() +
                        "\"\nprecision = \"" + precision + "\"\n"));
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const nlohmann::json solver = summary()["solver"];
    const nlohmann::json skipped = summary()["skipped_operations"];
    const auto calls = [&](const char* operation) {
      return std::find(skipped.begin(), skipped.end(), operation) == skipped.end();
    };
    const std::string chosen = solver["tangent"];
    if (std::string_view(GetParam()) == "auto") {
      EXPECT_TRUE(chosen == "recompute" || chosen == "two-stage") << chosen;
    } else {
      EXPECT_EQ(chosen, GetParam());
    }
    EXPECT_EQ(calls("product"), chosen == "recompute");
    EXPECT_EQ(calls("linearize"), chosen == "two-stage");
    EXPECT_EQ(calls("apply"), chosen == "two-stage");
    EXPECT_NEAR(summary()["probes"][1]["reaction"][0], force, 1e-6 * force);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Tangent,
                         testing::Values("auto", "recompute", "two-stage", "assembled"));

struct PrecisionOfScene {
  const char* precision;
  double tolerance;
  std::set<std::string> scalars;  ///< of the groups
};

void PrintTo(const PrecisionOfScene& p, std::ostream* out) { *out << p.precision; }

class ScenePrecision : public Run, public testing::WithParamInterface<PrecisionOfScene> {};

TEST_P(ScenePrecision, GivesTheReactionToItsRounding) {
  const std::string solver = fmt::format("[solver]\nprecision = \"{}\"\ntolerance = {}\n",
                                         GetParam().precision, GetParam().tolerance);
  const ProcessResult result = run_scene(write(pulled_bar + solver));
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json json = summary();
  EXPECT_EQ(json["solver"]["precision"], GetParam().precision);
  std::set<std::string> scalars;
  for (const auto& group : json["associations"]) scalars.insert(group["scalar"].get<std::string>());
  EXPECT_EQ(scalars, GetParam().scalars);
  const double force = 1.1 * 1e6 * (1.1 * 1.1 - 1) / 2;
  const double reached = json["probes"][1]["reaction"][0];
  EXPECT_NEAR(reached, force, GetParam().tolerance * force);
}

INSTANTIATE_TEST_SUITE_P(All, ScenePrecision,
                         testing::Values(PrecisionOfScene{"double", 1e-8, {"double"}},
                                         PrecisionOfScene{"mixed", 1e-8, {"double", "float"}},
                                         PrecisionOfScene{"single", 1e-4, {"float"}}),
                         [](const auto& info) { return std::string(info.param.precision); });

TEST_F(Run, KeepsWhatWasReachedWhenNewtonDoesNotConverge) {
  const ProcessResult result =
      run_scene(write("gravity = [0, 0, -100]\n" + pulled_bar + "[solver]\nmax_iterations = 1\n"));
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_EQ(summary()["solver"]["status"], "not converged");
  EXPECT_FALSE(summary()["solver"]["reason"].get<std::string>().empty());
  EXPECT_TRUE(std::filesystem::exists(out() / "result.vtu"));
}

TEST_F(Run, EndsAtTheNextIterationOnCtrlC) {
  // Conjugate gradient on this mesh takes far longer than noticing its first line.
  const std::string scene =
      "gravity = [0, 0, -9.81]\n" + pulled_bar + "[output]\nwrite = [\"vtu\"]\n";
  const std::string log = (out().parent_path() / "log").string();
  const std::string script =
      "\"$1\" run \"$2\" --out \"$3\" --cells 96x12x12 2> \"$4\" & pid=$!\n"
      "until grep -q '^newton' \"$4\" || ! kill -0 $pid; do sleep 0.02; done\n"
      "kill -INT $pid; wait $pid";
  const ProcessResult result = run_process({"env", cache_setting(), "sh", "-c", script, "sh",
                                            program(), write(scene).string(), out().string(), log});
  EXPECT_EQ(result.exit_status, 130) << result.output << read_text_file(log, "log");
  EXPECT_EQ(summary()["solver"]["status"], "interrupted");
  EXPECT_TRUE(std::filesystem::exists(out() / "result.vtu"));
}

class BadScene : public Run {
 protected:
  void expect_rejected(const std::string& text, const std::string& words) const {
    const ProcessResult result = run_scene(write(text));
    EXPECT_EQ(result.exit_status, 2) << result.output;
    EXPECT_NE(result.output.find("error: "), std::string::npos) << result.output;
    EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
    EXPECT_FALSE(std::filesystem::exists(out()));
  }
};

TEST_F(BadScene, InvertedElement) {
  expect_rejected(R"(gravity = [0, 0, -9.81]
[mesh]
nodes = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]]
[[mesh.block]]
association = "stvk-tet4-q1-none"
region = "body"
elements = [[0, 1, 2, 3], [0, 1, 2, 4]]
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { z = 0.0 }
fixed = ["x", "y", "z"]
)",
                  "element 1 ");
}

TEST_F(BadScene, UnknownKey) { expect_rejected("gravty = 1\n" + pulled_bar, "scene.toml:1"); }

TEST_F(BadScene, CellsInWrongForm) {
  const ProcessResult result = run_scene(write(pulled_bar), {"--cells", "4x2"});
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("as in 48x8x8"), std::string::npos) << result.output;
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(BadScene, OutIsAFile) {
  write_text_file(out(), "");
  const ProcessResult result = run_scene(write(pulled_bar));
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_NE(result.output.find("this is a file"), std::string::npos) << result.output;
}

/// A cantilever 4 m long and 1 m high, one element thick in space, with that displacement held.
std::string cantilever(const char* law, const char* plane_element, const char* solid_element,
                       bool plane, const char* force) {
  return fmt::format(
      "gravity = {0}\n[bar]\nlength = 4\nheight = 1\n{1}\n[[bar.section]]\nuntil = 1\n"
      "association = \"{2}-{3}-none\"\nregion = \"body\"\n[material.body]\ndensity = 1000\n"
      "young = 1e6\npoisson = 0.3\n[[constraint]]\nplane = {{ x = 0 }}\nfixed = [{4}]\n{5}"
      "[[load]]\nplane = {{ x = 4 }}\nforce = {6}\n[solver]\nmethod = \"cholesky\"\n"
      "tolerance = 1e-12\n[output]\nwrite = []\n",
      plane ? "[0, -1]" : "[0, 0, -1]", plane ? "cells = [8, 3]" : "width = 1\ncells = [8, 1, 3]",
      law, plane ? plane_element : solid_element, plane ? "\"x\", \"y\"" : "\"x\", \"y\", \"z\"",
      plane ? ""
            : "[[constraint]]\nbox = { min = [0.1, 0, 0], max = [4, 1, 1] }\nfixed = [\"y\"]\n",
      fmt::format("[0, {}-{}]", plane ? "" : "0, ", force));
}

TEST_F(Run, QuadrilateralsAreHexahedraHeldInPlaneStrain) {
  std::vector<std::vector<double>> tip;
  for (const bool plane : {true, false}) {
    const ProcessResult result =
        run_scene(write(cantilever("neo_hookean", "quad4-q4", "hexa8-q8", plane, "20000")));
    ASSERT_EQ(result.exit_status, 0) << result.output;
    tip.push_back(summary()["tip_displacement"]);
  }
  ASSERT_EQ(tip[0].size(), 2U);
  ASSERT_EQ(tip[1].size(), 3U);
  EXPECT_LT(tip[0][1], -0.5);  // far from small
  EXPECT_NEAR(tip[0][0], tip[1][0], 1e-10);
  EXPECT_NEAR(tip[0][1], tip[1][2], 1e-10);
}

TEST_F(Run, PlaneBarOfTrianglesAndQuadrilateralsCarriesItsWeight) {
  const ProcessResult result = run_scene(shipped("bar_planar"), {"--cells", "32x4"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json json = summary();
  EXPECT_EQ(json["mesh"]["elements"], 16 * 4 * 2 + 16 * 4);
  EXPECT_EQ(json["associations"][1]["geometry"], "box");
  const double weight = 1000 * 8 * 9.81;
  EXPECT_NEAR(json["probes"][0]["reaction"][1], weight, 1e-7 * weight);
  EXPECT_TRUE(std::filesystem::exists(out() / "result.vtu"));
}

// The mesh is the same in every version (VtkFile.HoldsTheSameMeshInEveryVersion); what is right was
// computed by an independent Newton program.
TEST_F(Run, TakesAMeshFromVtkAndItsOwnResultAsAMesh) {
  const std::string scene = R"(gravity = [0.0, 0.0, -9.81]
[mesh]
file = "FILE"
law = "neo_hookean"
split = "none"
[material.default]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
[[probe]]
name = "tip"
plane = { x = 2.0 }
[output]
write = ["vtu"]
)";
  const std::filesystem::path mesh =
      std::filesystem::path(ELASTOGEN_TEST_DATA) / "meshes" / "beam51b.vtk";
  const auto expect_tip = [&](const std::filesystem::path& file) {
    const ProcessResult result = run_scene(write(replaced_once(scene, "FILE", file.string())));
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const nlohmann::json tip = summary()["probes"][0]["displacement"];
    EXPECT_NEAR(tip[0], -0.011646, 5e-7);
    EXPECT_NEAR(tip[1], 0, 5e-7);
    EXPECT_NEAR(tip[2], -0.242399, 5e-7);
  };
  expect_tip(mesh);
  const std::filesystem::path result = out().parent_path() / "mesh.vtu";
  std::filesystem::rename(out() / "result.vtu", result);
  expect_tip(result);
}

}  // namespace
}  // namespace elastogen::selector
