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

TEST(Process, RefusesAMissingProgram) {
  EXPECT_THROW((void)run_process({"/nowhere/program"}), WorkError);
  EXPECT_FALSE(find_program("/nowhere/program").has_value());
  const EnvironmentVariable path("PATH", "/nowhere");
  EXPECT_FALSE(find_program("sh").has_value());
}

}  // namespace
}  // namespace elastogen::selector
