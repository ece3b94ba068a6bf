#include <gtest/gtest.h>

#include "runtime/error.h"
#include "selector/commands/kernel_folder.h"
#include "selector/support/files.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {
namespace fs = std::filesystem;

symgen::GeneratedAssociation fake_association(const std::string& law) {
  symgen::GeneratedAssociation generated;
  generated.id = {law, "tet4", "q1", "none"};
  generated.chosen_split = "none";
  generated.hash = "hash of " + law;
  return generated;
}

const KernelTarget target = {"cpu", "x86-dram"};

const SourceFiles files = {{"a.h", "text"}, {"a.cpp", "more"}};

TEST(KernelFolder, KnowsWhatIsNewOrChanged) {
  const TemporaryFolder folder;
  const symgen::GeneratedAssociation stvk = fake_association("stvk");
  EXPECT_TRUE(KernelFolder(folder.path()).write(stvk, target, files));
  EXPECT_FALSE(KernelFolder(folder.path()).write(stvk, target, files));
  EXPECT_TRUE(KernelFolder(folder.path()).write(stvk, target, {{"a.h", "text"}, {"a.cpp", "m"}}));
  EXPECT_TRUE(KernelFolder(folder.path()).write(fake_association("hooke"), target, {{"h", ""}}));
}

TEST(KernelFolder, MakesAgainWhatWasEditedOrRemoved) {
  const TemporaryFolder folder;
  const symgen::GeneratedAssociation stvk = fake_association("stvk");
  KernelFolder(folder.path()).write(stvk, target, files);
  write_text_file(folder.path() / "a.h", "edited");
  EXPECT_TRUE(KernelFolder(folder.path()).write(stvk, target, files));
  EXPECT_EQ(read_text_file(folder.path() / "a.h", "test"), "text");
  fs::remove(folder.path() / "a.cpp");
  EXPECT_TRUE(KernelFolder(folder.path()).write(stvk, target, files));
  EXPECT_EQ(read_text_file(folder.path() / "a.cpp", "test"), "more");
}

TEST(KernelFolder, KeepsOtherAssociationsAndTimeStamps) {
  const TemporaryFolder folder;
  const symgen::GeneratedAssociation stvk = fake_association("stvk");
  const symgen::GeneratedAssociation hooke = fake_association("hooke");
  KernelFolder(folder.path()).write(stvk, target, {{"s.h", "text"}});
  const auto before = fs::last_write_time(folder.path() / "s.h");
  KernelFolder(folder.path()).write(hooke, target, {{"h.h", "text"}});
  EXPECT_FALSE(KernelFolder(folder.path()).write(stvk, target, {{"s.h", "text"}}));
  EXPECT_FALSE(KernelFolder(folder.path()).write(hooke, target, {{"h.h", "text"}}));
  EXPECT_EQ(fs::last_write_time(folder.path() / "s.h"), before);
}

TEST(KernelFolder, HasAManifestThatDoesNotDependOnTheOrderOfWriting) {
  const TemporaryFolder one;
  const TemporaryFolder other;
  KernelFolder forward(one.path());
  forward.write(fake_association("stvk"), target, {{"s.h", "text"}});
  forward.write(fake_association("hooke"), target, {{"h.h", "text"}});
  KernelFolder backward(other.path());
  backward.write(fake_association("hooke"), target, {{"h.h", "text"}});
  backward.write(fake_association("stvk"), target, {{"s.h", "text"}});
  EXPECT_EQ(read_text_file(one.path() / "manifest.json", "test"),
            read_text_file(other.path() / "manifest.json", "test"));
}

TEST(KernelFolder, LeavesForeignFilesAlone) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "manifest.json", "{\"name\": \"something else\"}");
  EXPECT_THROW(KernelFolder{folder.path()}, InputError);
  write_text_file(folder.path() / "manifest.json", "no JSON");
  EXPECT_THROW(KernelFolder{folder.path()}, InputError);
  EXPECT_THROW(KernelFolder{folder.path() / "manifest.json"}, InputError);
}

}  // namespace
}  // namespace elastogen::selector
