// Kernels in somebody else's CMake build: an edited law rebuilds exactly its kernels.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "cmake_project.h"
#include "selector/support/files.h"
#include "tests/instruction_sets/library_members.h"

namespace elastogen::test {
namespace {
namespace fs = std::filesystem;

class KernelConsumer : public ::testing::Test {
 protected:
  /// One build serves all tests.
  static void SetUpTestSuite() {
    folder_.emplace();
    fs::copy(ELASTOGEN_SOURCE_DIR "/laws", laws());
    project_.emplace(ELASTOGEN_SOURCE_DIR "/tests/consumer/kernels",
                     std::vector<std::string>{"-DCMAKE_PREFIX_PATH=" + installed_package().string(),
                                              "-DLAWS=" + laws().string(),
                                              "-DELASTOGEN_KERNEL_FLAGS=-O0;-Wno-psabi"});
    (void)project_->build();
  }
  static void TearDownTestSuite() {
    project_.reset();
    folder_.reset();
  }

  /// Times of the generated sources and of the objects compiled from them, by file.
  std::map<std::string, fs::file_time_type> times(const std::string& law) const {
    std::map<std::string, fs::file_time_type> result;
    for (const auto& entry : fs::recursive_directory_iterator(project_->folder())) {
      const std::string name = entry.path().filename().string();
      const bool counts = entry.path().extension() != ".json" && entry.is_regular_file();
      if (counts && name.starts_with(law + "_tet4")) {
        result[entry.path().string()] = entry.last_write_time();
      }
    }
    return result;
  }

  void edit_law(const std::string& law, const std::string& what, const std::string& by) const {
    const fs::path file = laws() / (law + ".toml");
    std::string text = selector::read_text_file(file, "law");
    const std::size_t position = text.find(what);
    ASSERT_NE(position, std::string::npos) << text;
    text.replace(position, what.size(), by);
    selector::write_text_file(file, text);
  }

  [[nodiscard]] static fs::path laws() { return folder_->path() / "laws"; }

  static inline std::optional<selector::TemporaryFolder> folder_;
  static inline std::optional<CmakeProject> project_;
};

TEST_F(KernelConsumer, RebuildsExactlyTheKernelsOfAChangedLaw) {
  // As wide as this machine's vectors; twice as many floats as doubles.
  const std::string lanes = output_of({(project_->folder() / "consumer").string()});
  const std::set<std::string> possible = {"hooke-tet4-q1-none 2\nstvk-tet4-q1-none 4\n",
                                          "hooke-tet4-q1-none 4\nstvk-tet4-q1-none 8\n",
                                          "hooke-tet4-q1-none 8\nstvk-tet4-q1-none 16\n"};
  EXPECT_TRUE(possible.contains(lanes)) << lanes;
  const auto hooke = times("hooke");
  const auto stvk = times("stvk");
#if defined(__x86_64__)
  constexpr std::size_t num_sets = 3;
#else
  constexpr std::size_t num_sets = 1;
#endif
  // Two headers, two sources; in each precision a source and an object for each set, and for the
  // choice.
  ASSERT_EQ(hooke.size(), 4 + 2 * 2 * (num_sets + 1));

  // A comment: the generator looks, and touches nothing.
  edit_law("hooke", "name", "# a remark\nname");
  EXPECT_NE(project_->build().find("up to date  hooke-tet4-q1-none"), std::string::npos);
  EXPECT_EQ(times("hooke"), hooke);

  edit_law("hooke", "mu*tr", "2*mu*tr");
  const std::string output = project_->build();
  EXPECT_NE(output.find("generated   hooke-tet4-q1-none"), std::string::npos) << output;
  EXPECT_EQ(output.find("stvk-tet4-q1-none"), std::string::npos) << output;
  EXPECT_NE(times("hooke"), hooke);
  EXPECT_EQ(times("stvk"), stvk);
}

TEST_F(KernelConsumer, HasABuildForEachInstructionSet) {
#if defined(__x86_64__)
  const selector::ProcessResult run = selector::run_process(
      {(project_->folder() / "consumer").string()},
      {.folder = {}, .environment = {{"ELASTOGEN_INSTRUCTION_SET", "x86_64"}}});
  EXPECT_EQ(run.output, "hooke-tet4-q1-none 2\nstvk-tet4-q1-none 4\n");
#endif
  // At -O0 every inline function that is called is a symbol.
  if (!selector::find_program("nm")) GTEST_SKIP() << "nm is not installed";
  const auto symbols = defined_symbols((project_->folder() / "libbar_kernels.a").string());
  EXPECT_GE(symbols.size(), 2U);  // the choice and at least one set
  expect_disjoint(symbols);
}

}  // namespace
}  // namespace elastogen::test
