#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>

#include "runtime/error.h"
#include "selector/support/files.h"
#include "selector/support/process.h"
#include "selector/support/temporary_file.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {
namespace fs = std::filesystem;

TEST(Files, WritesIntoNewFoldersAndReplaces) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a" / "b.txt";
  write_text_file(file, "first");
  write_text_file(file, "second");
  EXPECT_EQ(read_text_file(file, "test"), "second");
  // No temporary file stays behind.
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator{}), 1);
}

TEST(Files, SaysWhatCannotBeReadAndWhy) {
  const TemporaryFolder folder;
  const std::string missing =
      message_of<InputError>([&] { (void)read_text_file(folder.path() / "case.json", "input"); });
  EXPECT_NE(missing.find("input file '"), std::string::npos) << missing;
  EXPECT_NE(missing.find("does not exist"), std::string::npos) << missing;
  const std::string is_folder =
      message_of<InputError>([&] { (void)read_text_file(folder.path(), "input"); });
  EXPECT_NE(is_folder.find("is a folder"), std::string::npos) << is_folder;
}

TEST(Files, FailsWhereAFileStandsInTheWay) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "file", "");
  EXPECT_THROW(write_text_file(folder.path() / "file" / "below", ""), WorkError);
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

TEST(RemoveLeftTemporaries, TakesThoseOfProcessesThatAreGone) {
  const TemporaryFolder folder;
  const std::string gone = [] {
    const std::string printed = run_process({"sh", "-c", "echo $$"}).output;
    return printed.substr(0, printed.find('\n'));
  }();
  const std::string living = std::to_string(getpid()), parent = std::to_string(getppid());
  std::set<std::string> kept = {"deformed.png",
                                ".deformed.png",
                                "deformed.elastogen-" + gone + ".png",
                                ".notes.elastogen-" + gone + ".txt",
                                ".elastogen-" + gone + ".png",
                                ".deformed.elastogen-0.png",
                                ".deformed.elastogen-.png",
                                ".deformed.elastogen--" + gone + ".png",
                                ".deformed.elastogen-" + gone + "x.png",
                                ".deformed.elastogen-" + living + ".png",
                                ".summary.json.elastogen-" + parent + ".aB3dE9",
                                ".folder.elastogen-" + gone + ".png"};
  fs::create_directory(folder.path() / (".folder.elastogen-" + gone + ".png"));
  std::set<std::string> all = kept;
  all.insert({".deformed.elastogen-" + gone + ".png", ".deformed.elastogen-" + gone + ".gnuplot",
              ".summary.json.elastogen-" + gone + ".aB3dE9"});
  for (const std::string& name : all) {
    if (!fs::exists(folder.path() / name)) std::ofstream(folder.path() / name) << "text";
  }
  ASSERT_EQ(names_in(folder.path()), all);
  remove_left_temporaries(folder.path());
  EXPECT_EQ(names_in(folder.path()), kept);
  remove_left_temporaries(folder.path() / "nowhere");
}

TEST(RemoveLeftTemporaries, LeavesHiddenFilesOfUsers) {
  const TemporaryFolder folder;
  const std::string printed = run_process({"sh", "-c", "echo $$"}).output;
  const std::string gone = printed.substr(0, printed.find('\n'));
  const std::set<std::string> names = {".notes." + gone + ".backup", ".deformed." + gone + ".png",
                                       ".a.xelastogen-" + gone + ".backup"};
  for (const std::string& name : names) std::ofstream(folder.path() / name) << "text";
  remove_left_temporaries(folder.path());
  EXPECT_EQ(names_in(folder.path()), names);
}

/// What a process leaves that is killed while it writes is what is removed.
TEST(RemoveLeftTemporaries, KnowsWhatAKilledProcessLeaves) {
  const TemporaryFolder folder;
  for (const auto& [file, ending] : {std::pair{"deformed.png", "png"}, {"a.vtu", "aB3dE9"}}) {
    const pid_t child = fork();
    if (child == 0) {
      std::ofstream(temporary_beside(folder.path() / file, file, ending)) << "half" << std::flush;
      raise(SIGKILL);
    }
    EXPECT_EQ(waitpid(child, nullptr, 0), child);
    EXPECT_EQ(names_in(folder.path()).size(), 1U);
    remove_left_temporaries(folder.path());
    EXPECT_EQ(names_in(folder.path()).size(), 0U);
  }
}

}  // namespace
}  // namespace elastogen::selector
