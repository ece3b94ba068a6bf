#include <gtest/gtest.h>

#include <csignal>

#include "runtime/error.h"
#include "selector/support/process.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {

TEST(Process, ReturnsOutputAndStatus) {
  const ProcessResult result = run_process({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exit_status, 3);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.output, "out\nerr\n");
}

TEST(Process, PassesArgumentsAsTheyAre) {
  EXPECT_EQ(run_process({"printf", "%s", "two words; $HOME"}).output, "two words; $HOME");
}

TEST(Process, TellsTheSignal) {
  EXPECT_EQ(run_process({"sh", "-c", "kill -INT $$"}).signal, SIGINT);
}

TEST(Process, RunsInAFolderWithAnEnvironment) {
  const TemporaryFolder folder;
  const EnvironmentVariable before("ELASTOGEN_TEST_SETTING", "ours");
  const ProcessOptions options{folder.path(), {{"ELASTOGEN_TEST_SETTING", "theirs"}}, 0};
  EXPECT_EQ(run_process({"sh", "-c", "pwd; echo $ELASTOGEN_TEST_SETTING"}, options).output,
            folder.path().string() + "\ntheirs\n");
  EXPECT_EQ(run_process({"sh", "-c", "echo $ELASTOGEN_TEST_SETTING"}).output, "ours\n");
  EXPECT_THROW((void)run_process({"true"}, {folder.path() / "missing", {}, 0}), WorkError);
}

TEST(Process, MeasuresItsTimes) {
  const ProcessResult idle = run_process({"sleep", "0.2"});
  EXPECT_GE(idle.wall_seconds, 0.2);
  EXPECT_LT(idle.cpu_seconds, 0.1);
  const ProcessResult busy =
      run_process({"sh", "-c", "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done"});
  EXPECT_GT(busy.cpu_seconds, 0.005);
}

TEST(Process, IsKilledWhenItsTimeIsOver) {
  // The sleep holds the output open after the shell was killed.
  const ProcessResult result =
      run_process({"sh", "-c", "echo begun; sleep 20; true"}, {{}, {}, 0.3});
  EXPECT_TRUE(result.timed_out);
  EXPECT_EQ(result.signal, SIGKILL);
  EXPECT_EQ(result.output, "begun\n");
  EXPECT_LT(result.wall_seconds, 10);
  EXPECT_FALSE(run_process({"true"}, {{}, {}, 60}).timed_out);
}

TEST(Process, RefusesAMissingProgram) {
  EXPECT_THROW((void)run_process({"/nowhere/program"}), WorkError);
  EXPECT_FALSE(find_program("/nowhere/program").has_value());
  const EnvironmentVariable path("PATH", "/nowhere");
  EXPECT_FALSE(find_program("sh").has_value());
}

}  // namespace
}  // namespace elastogen::selector
