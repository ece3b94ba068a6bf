// Mistakes in what a scene says of time, load steps and records: where, what was found, what is
// allowed. And checkpoints, which come back as they were or not at all.
#include <gtest/gtest.h>

#include <ostream>

#include "selector/scene/checkpoint.h"
#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

/// Text put before the good scene's [bar], and pieces of the message.
struct StepMistake {
  const char* name;
  const char* text;
  std::vector<std::string> message;
};

void PrintTo(const StepMistake& mistake, std::ostream* out) { *out << mistake.name; }

class SceneStepMistake : public testing::TestWithParam<StepMistake> {};

TEST_P(SceneStepMistake, IsExplained) {
  const std::string message =
      error_of(replaced(good_scene, "[bar]", std::string(GetParam().text) + "\n[bar]"));
  for (const std::string& piece : GetParam().message) expect_contains(message, piece);
}

#define IMPLICIT "[dynamics]\nscheme = \"implicit_euler\"\nend = 1\nstep = 0.1\n"
#define EXPLICIT "[dynamics]\nscheme = \"central_differences\"\nend = 1\n"
#define MOVED "[[constraint]]\nplane = { x = 2 }\n"

INSTANTIATE_TEST_SUITE_P(
    All, SceneStepMistake,
    testing::Values(
        StepMistake{"UnknownScheme",
                    "[dynamics]\nscheme = \"implicit_euller\"",
                    {"scene.toml:3: dynamics.scheme = 'implicit_euller': must be one of: "
                     "implicit_euler, symplectic_euler, central_differences",
                     "did you mean 'implicit_euler'?"}},
        StepMistake{"NoEnd",
                    "[dynamics]\nscheme = \"implicit_euler\"\nstep = 0.1",
                    {"scene.toml:2: dynamics: the key 'end' is missing"}},
        StepMistake{"ImplicitWithoutStep",
                    "[dynamics]\nscheme = \"implicit_euler\"\nend = 1",
                    {"dynamics: the key 'step' is missing"}},
        StepMistake{"StepLongerThanTheMotion",
                    "[dynamics]\nscheme = \"implicit_euler\"\nend = 1\nstep = 2",
                    {"scene.toml:5: dynamics.step = 2: must not be longer", "end = 1"}},
        StepMistake{"NegativeDamping",
                    EXPLICIT "damping = -1",
                    {"dynamics.damping = -1: must be at least 0"}},
        StepMistake{"SystemsOfAnExplicitScheme",
                    EXPLICIT "newton_iterations = 3",
                    {"dynamics.newton_iterations = 3: is for implicit_euler"}},
        StepMistake{"SleepOfAnImplicitScheme",
                    IMPLICIT "[skip]\nsleep = { motion = 1e-6 }",
                    {"scene.toml:7: skip.sleep: is for motions by symplectic_euler or "
                     "central_differences"}},
        StepMistake{"SleepInStatics",
                    "[skip]\nsleep = { motion = 1e-6 }",
                    {"skip.sleep: is for motions by symplectic_euler"}},
        StepMistake{"SleepWithoutMotion",
                    EXPLICIT "[skip]\nsleep = { steps = 3 }",
                    {"skip.sleep: the key 'motion' is missing"}},
        StepMistake{"SleepOfNegativeMotion",
                    EXPLICIT "[skip]\nsleep = { motion = -1e-6 }",
                    {"skip.sleep.motion = -1e-06: must be greater than 0"}},
        StepMistake{"SleepAtOnce",
                    EXPLICIT "[skip]\nsleep = { motion = 1e-6, steps = 0 }",
                    {"skip.sleep.steps = 0: must be an integer, at least 1"}},
        StepMistake{"SkipOfSomethingElse",
                    "[skip]\nrest = true",
                    {"skip.rest", "at_rest, congruent, sleep"}},
        StepMistake{"ToleranceOfNoIteration",
                    IMPLICIT "newton_tolerance = 1e-6",
                    {"newton_tolerance", "newton_iterations = 2 or more"}},
        StepMistake{"RestWithoutPeriod",
                    IMPLICIT "rest = { energy_per_node = 1 }",
                    {"dynamics.rest: the key 'period' is missing"}},
        StepMistake{"StaticKeysOfAMotion",
                    IMPLICIT "[solver]\nload_steps = 3",
                    {"unknown key 'solver.load_steps'",
                     "may have: method, tangent, project, precision, threads"}},
        StepMistake{"MethodOfAnExplicitScheme",
                    EXPLICIT "[solver]\nmethod = \"cg\"",
                    {"unknown key 'solver.method'", "may have: precision, threads"}},
        StepMistake{"NothingToMixInAnExplicitScheme",
                    EXPLICIT "[solver]\nprecision = \"mixed\"",
                    {"solver.precision = 'mixed': must be one of: double, single"}},
        StepMistake{"MotionWithoutHistory",
                    IMPLICIT MOVED "displacement = { x = 1 }",
                    {"constraint[1]: moves, but does not say when", "history = [[0, 0], [1, 1]]"}},
        StepMistake{"HistoryOfNothing",
                    IMPLICIT MOVED "fixed = [\"x\"]\nhistory = [[0, 0]]",
                    {"constraint[1]: has a history, but nothing that moves"}},
        StepMistake{"TimesThatDoNotAscend",
                    IMPLICIT MOVED "displacement = { x = 1 }\nhistory = [[0, 0], [0, 1]]",
                    {"scene.toml:9: constraint[1].history: times of a history must ascend"}},
        StepMistake{"HistoryAndSine",
                    IMPLICIT MOVED "displacement = { x = 1 }\nhistory = [[0, 0]]\nsine = 1",
                    {"constraint[1].sine = 1: give either this or history"}},
        StepMistake{"SineInStatics",
                    MOVED "displacement = { x = 1 }\nsine = 1",
                    {"constraint[1].sine = 1: is for scenes with [dynamics]"}},
        StepMistake{"RotationAndFixed",
                    MOVED "fixed = [\"x\"]\nrotation = { point = [0, 0, 0], axis = [1, 0, 0], "
                          "turns = 1 }",
                    {"constraint[1].rotation", "without 'fixed' and 'displacement'"}},
        StepMistake{"RotationWithoutAxis",
                    MOVED "rotation = { point = [0, 0, 0], axis = [0, 0, 0], turns = 1 }",
                    {"constraint[1].rotation.axis", "must not be 0"}},
        StepMistake{"TwoCourses",
                    "[[constraint]]\nplane = { y = 0 }\nrotation = { point = [0, 0, 0], axis = "
                    "[1, 0, 0], turns = 1 }",
                    {"scene.toml:19: constraint: node 0 is selected here and by the constraint of ",
                     "scene.toml:3, and one of the two moves", "select it once"}},
        StepMistake{"NoMass",
                    IMPLICIT "[material.other]\nregions = [\"other\"]\ndensity = 0",
                    {"material.other.density = 0: must be greater than 0"}},
        StepMistake{"SeriesOfOneSolve",
                    "[output]\nwrite = [\"series\"]",
                    {"output.write", "need [dynamics], or load_steps of 2 or more"}},
        StepMistake{"EveryWithoutSeries",
                    IMPLICIT "[output]\nwrite = [\"vtu\"]\nevery = 2",
                    {"output.every = 2: is of the series, which is not written"}},
        StepMistake{"EnergyInStatics",
                    "[output]\nenergy = true",
                    {"output.energy = true: is for [dynamics]"}},
        StepMistake{"EnergyIsNoNumber",
                    IMPLICIT "[output]\nenergy = 1",
                    {"output.energy = 1: must be true or false"}},
        StepMistake{
            "UnknownReference",
            "[reference]\nfile = \"other.txt\"",
            {"reference.file = 'other.txt': must be a deflection curve (.csv) or a result"}},
        StepMistake{"MissingReferenceField",
                    "[reference]\nfile = \"other.vtu\"",
                    {"reference.file: ", "other.vtu: is no VTU file"}}),
    [](const testing::TestParamInfo<StepMistake>& mistake) { return mistake.param.name; });

TEST(SceneErrors, MaterialOfARegionWhoseNameNeedsQuotes) {
  expect_contains(error_of(replaced(good_scene, "region = \"body\"", "region = \"left part\"")),
                  "add [material.\"left part\"]");
}

TEST(SceneErrors, MeasureNamesWhatCanBeMeasured) {
  expect_contains(error_of("measure = [\"mass\"]\n" + good_scene),
                  "scene.toml:1: measure = [ 'mass' ]: 'mass' cannot be measured");
}

/// A checkpoint written and read.
Checkpoint kept(const Checkpoint& checkpoint) {
  const TemporaryFolder folder;
  write_checkpoint(checkpoint_file(folder.path()), checkpoint);
  return read_checkpoint(checkpoint_file(folder.path()));
}

TEST(Checkpoints, KeepEveryBitOfAMotion) {
  Checkpoint checkpoint;
  checkpoint.fingerprint = "abc";
  checkpoint.threads = 2;
  checkpoint.quiet_steps = 5;
  checkpoint.history_bytes = 1234567890123;
  checkpoint.series = {{0, "series/step_000000.vtu"}, {0.1, "series/step_000001.vtu"}};
  MotionState motion;
  motion.step = 7;
  motion.u = Vector::Random(9);
  motion.v = Vector::Constant(9, 5e-324);
  motion.a = -Vector::Zero(9);
  motion.a_before = Vector::Random(9);
  checkpoint.motion = motion;
  const Checkpoint read = kept(checkpoint);
  EXPECT_EQ(read.fingerprint, "abc");
  EXPECT_EQ(read.threads, 2);
  EXPECT_EQ(read.quiet_steps, 5);
  EXPECT_EQ(read.history_bytes, 1234567890123U);
  ASSERT_EQ(read.series.size(), 2U);
  EXPECT_EQ(read.series[1].time, 0.1);
  EXPECT_EQ(read.series[1].name, "series/step_000001.vtu");
  ASSERT_TRUE(read.motion.has_value());
  EXPECT_EQ(read.motion->u, motion.u);
  EXPECT_EQ(read.motion->v, motion.v);
  EXPECT_TRUE(std::signbit(read.motion->a[0]));
  EXPECT_EQ(read.position(0.5).step, 7);
  EXPECT_EQ(read.position(0.5).time, 3.5);
}

TEST(Checkpoints, KeepEveryBitOfALoadStep) {
  Checkpoint checkpoint;
  checkpoint.load = LoadState{Vector::Random(6), 1.0 / 3, 0.1, 3, 21};
  const Checkpoint read = kept(checkpoint);
  ASSERT_TRUE(read.load.has_value());
  EXPECT_EQ(read.load->u, checkpoint.load->u);
  EXPECT_EQ(read.load->load_factor, 1.0 / 3);
  EXPECT_EQ(read.load->increment, 0.1);
  EXPECT_EQ(read.load->iterations, 21);
  EXPECT_EQ(read.position(0).step, 3);
}

TEST(Checkpoints, RefuseDamage) {
  const TemporaryFolder folder;
  Checkpoint checkpoint;
  checkpoint.load = LoadState{Vector::Random(6), 0.5, 0.1, 3, 21};
  const std::filesystem::path file = checkpoint_file(folder.path());
  write_checkpoint(file, checkpoint);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW((void)read_checkpoint(file), InputError);
  EXPECT_THROW((void)read_checkpoint(folder.path() / "none"), InputError);
}

}  // namespace
}  // namespace elastogen::selector
