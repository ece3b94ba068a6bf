// One test per mistake that a scene file can hold: the message must say where, what was found and
// what is allowed.
#include <gtest/gtest.h>

#include <ostream>

#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

/// A piece of the good scene, what it is replaced by, and pieces of the message.
struct Mistake {
  const char* name;
  const char* piece;
  const char* by;
  std::vector<std::string> message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class SceneMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SceneMistake, IsExplained) {
  const Mistake& mistake = GetParam();
  const std::string message = error_of(replaced(good_scene, mistake.piece, mistake.by));
  for (const std::string& piece : mistake.message) expect_contains(message, piece);
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneMistake,
    testing::Values(
        Mistake{"NoToml", "[bar]", "[bar", {"scene.toml:2: this is no TOML"}},
        Mistake{"UnknownTopKey",
                "gravity",
                "gravty",
                {"scene.toml:1: unknown key 'gravty'", "did you mean 'gravity'?"}},
        Mistake{"UnknownKeyInTable",
                "cells",
                "cell",
                {"scene.toml:6: unknown key 'bar.cell'", "did you mean 'cells'?"}},
        Mistake{"UnknownLaw",
                "stvk-",
                "stvkk-",
                {"scene.toml:9: bar.section[1].association", "stvkk", "stvk"}},
        Mistake{"UnknownElement", "hexa8", "hexa9", {"scene.toml:9", "hexa9", "hexa8"}},
        Mistake{"UnknownQuadrature", "q8", "q9", {"scene.toml:9", "q9", "q8"}},
        Mistake{"UnknownSplit", "q8-none", "q8-nnoe", {"scene.toml:9", "nnoe"}},
        Mistake{"NoAssociation", "stvk-hexa8-q8-none", "stvk", {"scene.toml:9", "stvk"}},
        Mistake{"PoissonOneHalf",
                "0.3",
                "0.5",
                {"scene.toml:14: material.body.poisson = 0.5: must be in (-1, 0.5) for law 'stvk'",
                 "0.4999"}},
        Mistake{"PoissonMinusOne",
                "0.3",
                "-1.0",
                {"material.body.poisson = -1: must be in (-1, 0.5)", "from -0.9999"}},
        Mistake{"YoungNotPositive",
                "1e6",
                "0",
                {"scene.toml:13: material.body.young = 0: must be greater than 0"}},
        Mistake{"NegativeDensity",
                "1000.0",
                "-1.0",
                {"scene.toml:12: material.body.density = -1: must be at least 0"}},
        Mistake{"InfiniteNumber", "1000.0", "inf", {"material.body.density = inf: must be"}},
        Mistake{"TextForANumber",
                "1000.0",
                "\"heavy\"",
                {"material.body.density = 'heavy': must be a number"}},
        Mistake{"MissingKey",
                "density = 1000.0\n",
                "",
                {"material.body: the key 'density' is missing"}},
        Mistake{"MissingParameter",
                "poisson = 0.3\n",
                "",
                {"material.body: the key 'poisson' is missing"}},
        Mistake{"UnknownParameter",
                "poisson",
                "poison",
                {"unknown key 'material.body.poison'", "did you mean 'poisson'?"}},
        Mistake{"BothKindsOfParameters",
                "poisson = 0.3",
                "poisson = 0.3\nmu = 1.0",
                {"material.body.mu = 1: give either young and poisson"}},
        Mistake{"RegionWithoutMaterial",
                "region = \"body\"",
                "region = \"bodi\"",
                {"scene.toml:10: bar.section[1].region = 'bodi': this region has no material",
                 "did you mean 'body'?", "[material.bodi]"}},
        Mistake{"MaterialWithoutRegion",
                "density",
                "regions = [\"body\", \"tail\"]\ndensity",
                {"there is no region 'tail'"}},
        Mistake{"TwoMaterialsOfARegion",
                "[[constraint]]",
                "[material.b]\nregions = [\"body\"]\ndensity = 1\nyoung = 1\npoisson = 0\n"
                "[[constraint]]",
                {"material.b: region 'body' has a material already"}},
        Mistake{"NegativeLength",
                "2.0",
                "-2.0",
                {"scene.toml:3: bar.length = -2: must be greater than 0"}},
        Mistake{
            "NoCells", "[2, 1, 1]", "[2, 0, 1]", {"bar.cells = 0: must be an integer, at least 1"}},
        Mistake{
            "FractionOfACell", "[2, 1, 1]", "[2.5, 1, 1]", {"bar.cells = 2.5: must be an integer"}},
        Mistake{"TwoDimensions", "[2, 1, 1]", "[2, 1]", {"must have 3 entries, not 2"}},
        Mistake{"SectionsEndEarly",
                "until = 1.0",
                "until = 0.5",
                {"bar.section[1].until = 0.5: must be 1 in the last section"}},
        Mistake{"SectionBeyondTheEnd",
                "until = 1.0",
                "until = 1.5",
                {"bar.section[1].until = 1.5: must be in (0, 1]"}},
        Mistake{"NothingFixed",
                "[[constraint]]\nplane = { x = 0.0 }\nfixed = [\"x\", \"y\", \"z\"]",
                "",
                {"nothing is fixed"}},
        Mistake{"SlidingBody",
                "[\"x\", \"y\", \"z\"]",
                "[\"x\", \"z\"]",
                {"the constraints leave 1 of the 6 rigid motions", "a translation along y"}},
        Mistake{
            "NoSuchComponent", "[\"x\", \"y\", \"z\"]", "[\"x\", \"u\"]", {"'u' is no component"}},
        Mistake{"ConstrainsNothing",
                "fixed = [\"x\", \"y\", \"z\"]",
                "",
                {"scene.toml:15: constraint[1]: constrains nothing"}},
        Mistake{"PlaneMissesTheMesh",
                "plane = { x = 0.0 }",
                "plane = { x = 7.0 }",
                {"scene.toml:16: plane x = 7 selects no node", "[0, 0, 0] to [2, 1, 1]"}},
        Mistake{"BoxInsideOut",
                "plane = { x = 0.0 }",
                "box = { min = [1, 0, 0], max = [0, 1, 1] }",
                {"must not exceed max", "along x"}},
        Mistake{"PlaneAndBox",
                "plane = { x = 0.0 }",
                "plane = { x = 0.0 }\nbox = { min = [0, 0, 0], max = [0, 1, 1] }",
                {"constraint[1]: needs one of plane"}},
        Mistake{"TwoPlanes", "{ x = 0.0 }", "{ x = 0.0, y = 0.0 }", {"must give one of x, y, z"}},
        Mistake{"ContradictoryConstraints",
                "fixed = [\"x\", \"y\", \"z\"]",
                "fixed = [\"x\", \"y\", \"z\"]\n[[constraint]]\nplane = { x = 0 }\n"
                "displacement = { z = 0.1 }",
                {"scene.toml:19: constraint"}},
        Mistake{"NoForce",
                "[[constraint]]",
                "[[load]]\nplane = { x = 2 }\n[[constraint]]",
                {"load[1]: needs one of force"}},
        Mistake{"ForceAndPressure",
                "[[constraint]]",
                "[[load]]\nplane = { x = 2 }\nforce = [0, 0, 1]\npressure = 1\n[[constraint]]",
                {"load[1]: needs one of force"}},
        Mistake{"PressureInsideTheBody",
                "[[constraint]]",
                "[[load]]\nplane = { x = 1 }\npressure = 1\n[[constraint]]",
                {"plane x = 1 has 4 nodes, but no face of the surface"}},
        Mistake{"BoundaryOfABar",
                "plane = { x = 0.0 }",
                "boundary = \"clamp\"",
                {"boundary 'clamp': the mesh has no boundaries"}},
        Mistake{"UnknownMethod",
                "[bar]",
                "[solver]\nmethod = \"cholesk\"\n[bar]",
                {"solver.method = 'cholesk': must be one of: auto, cg, cholesky",
                 "did you mean 'cholesky'?"}},
        Mistake{"UnknownTangent",
                "[bar]",
                "[solver]\ntangent = \"two_stage\"\n[bar]",
                {"solver.tangent = 'two_stage': must be one of: auto, recompute, two-stage, "
                 "assembled",
                 "did you mean 'two-stage'?"}},
        Mistake{"TangentWithoutProducts",
                "[bar]",
                "[solver]\nmethod = \"cholesky\"\ntangent = \"assembled\"\n[bar]",
                {"solver.tangent = 'assembled': is for methods with conjugate gradient"}},
        Mistake{"ToleranceZero",
                "[bar]",
                "[solver]\ntolerance = 0.0\n[bar]",
                {"solver.tolerance = 0: must be in (0, 1)"}},
        Mistake{
            "UnknownOutput", "[bar]", "[output]\nwrite = [\"vtk\"]\n[bar]", {"'vtk' is no output"}},
        Mistake{"MissingLawFile",
                "gravity",
                "laws = [\"mine.toml\"]\ngravity",
                {"scene.toml:1: laws", "mine.toml"}},
        Mistake{"MissingReference",
                "[bar]",
                "[reference]\nfile = \"none.csv\"\n[bar]",
                {"scene.toml:3: reference.file", "none.csv", "no such file"}},
        Mistake{"BarAndMesh",
                "[bar]",
                "[mesh]\nnodes = []\n[bar]",
                {"a scene needs a [bar], a [sphere] or a [mesh]"}},
        Mistake{"ProbesOfOneName",
                "[[constraint]]",
                "[[probe]]\nname = \"a\"\nplane = { x = 0 }\n[[probe]]\nname = \"a\"\n"
                "plane = { x = 0 }\n[[constraint]]",
                {"probe[2].name = 'a': another probe has this name"}}),
    [](const testing::TestParamInfo<Mistake>& mistake) { return mistake.param.name; });

TEST(SceneErrors, MissingSceneFile) {
  try {
    (void)read_scene("/nowhere/scene.toml");
    FAIL();
  } catch (const InputError& error) {
    expect_contains(error.what(), "/nowhere/scene.toml: no such file");
  }
}

TEST(SceneErrors, GoodSceneHasNone) { EXPECT_EQ(error_of(good_scene), ""); }

}  // namespace
}  // namespace elastogen::selector
