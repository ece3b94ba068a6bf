#include <gtest/gtest.h>

#include <chrono>

#include "runtime/error.h"
#include "selector/jit/cache.h"
#include "selector/support/files.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {
namespace fs = std::filesystem;

TEST(DefaultCacheFolder, TakesTheFirstThatIsSet) {
  const EnvironmentVariable own("ELASTOGEN_CACHE_DIR", "/own");
  const EnvironmentVariable xdg("XDG_CACHE_HOME", "/xdg");
  const EnvironmentVariable home("HOME", "/home/somebody");
  EXPECT_EQ(default_cache_folder(), "/own");
  const EnvironmentVariable no_own("ELASTOGEN_CACHE_DIR", std::nullopt);
  EXPECT_EQ(default_cache_folder(), "/xdg/elastogen");
  const EnvironmentVariable no_xdg("XDG_CACHE_HOME", "");
  EXPECT_EQ(default_cache_folder(), "/home/somebody/.cache/elastogen");
}

TEST(DefaultCacheFolder, IsPrivateWithoutAHome) {
  const TemporaryFolder temporary;
  const EnvironmentVariable own("ELASTOGEN_CACHE_DIR", std::nullopt);
  const EnvironmentVariable xdg("XDG_CACHE_HOME", std::nullopt);
  const EnvironmentVariable home("HOME", std::nullopt);
  const EnvironmentVariable tmpdir("TMPDIR", temporary.path().string());
  const fs::path folder = default_cache_folder();
  EXPECT_EQ(folder.parent_path(), temporary.path());
  EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
  // Libraries in it are executed: one that others could write to is refused.
  fs::permissions(folder, fs::perms::all);
  EXPECT_THROW((void)default_cache_folder(), WorkError);
}

TEST(WorkFolder, VanishesUnlessPublished) {
  const TemporaryFolder cache;
  fs::path dropped;
  {
    const WorkFolder work(cache.path() / "new");
    dropped = work.path();
    EXPECT_TRUE(fs::is_directory(dropped));
  }
  EXPECT_FALSE(fs::exists(dropped));
  WorkFolder work(cache.path());
  write_text_file(work.path() / "file", "text");
  work.publish(cache.path() / "entry");
  EXPECT_EQ(read_text_file(cache.path() / "entry" / "file", "test"), "text");
}

TEST(WorkFolder, LeavesTheEntryOfAFasterProcess) {
  const TemporaryFolder cache;
  write_text_file(cache.path() / "entry" / "file", "first");
  fs::path dropped;
  {
    WorkFolder work(cache.path());
    dropped = work.path();
    write_text_file(work.path() / "file", "second");
    work.publish(cache.path() / "entry");
  }
  EXPECT_EQ(read_text_file(cache.path() / "entry" / "file", "test"), "first");
  EXPECT_FALSE(fs::exists(dropped));
}

TEST(WorkFolder, SaysHowToMoveACacheThatCannotBeWritten) {
  const TemporaryFolder cache;
  write_text_file(cache.path() / "file", "");
  const std::string message =
      message_of<WorkError>([&] { const WorkFolder work(cache.path() / "file"); });
  EXPECT_NE(message.find("ELASTOGEN_CACHE_DIR"), std::string::npos) << message;
}

TEST(RemoveStaleWorkFolders, TakesOnlyOldOnes) {
  const TemporaryFolder cache;
  WorkFolder young(cache.path());
  WorkFolder old(cache.path());
  fs::create_directory(cache.path() / "entry");
  const auto two_days_ago = fs::file_time_type::clock::now() - std::chrono::hours(48);
  fs::last_write_time(old.path(), two_days_ago);
  fs::last_write_time(cache.path() / "entry", two_days_ago);
  remove_stale_work_folders(cache.path());
  EXPECT_TRUE(fs::exists(young.path()));
  EXPECT_FALSE(fs::exists(old.path()));
  EXPECT_TRUE(fs::exists(cache.path() / "entry"));
}

}  // namespace
}  // namespace elastogen::selector
