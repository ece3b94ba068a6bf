#include <gtest/gtest.h>

#include "runtime/error.h"
#include "selector/support/files.h"
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

}  // namespace
}  // namespace elastogen::selector
