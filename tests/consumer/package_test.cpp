// Simulators that link elastogen: from the installed package, and from its sources without GiNaC.
#include <gtest/gtest.h>

#include <cstdio>

#include "cmake_project.h"
#include "selector/support/files.h"

namespace elastogen::test {
namespace {
namespace fs = std::filesystem;

/// Static equilibrium of the example's beam, by `elastogen run` with
/// examples/time_loop/static.toml.
constexpr double static_tip = -0.104217;     // m
constexpr double static_energy = 13.106009;  // J

void expect_at_rest(const std::string& printed) {
  double tip = 0, energy = 0;
  ASSERT_EQ(std::sscanf(printed.c_str(), "tip %lf m, energy %lf J", &tip, &energy), 2) << printed;
  EXPECT_NEAR(tip, static_tip, 2e-6);
  EXPECT_NEAR(energy, static_energy, 1e-4);
}

TEST(Package, IsFoundAndRunsTheExample) {
  const CmakeProject project(ELASTOGEN_SOURCE_DIR "/examples/time_loop",
                             {"-DCMAKE_PREFIX_PATH=" + installed_package().string()});
  (void)project.build();
  expect_at_rest(output_of({(project.folder() / "time_loop").string()}));
}

TEST(Package, NamesNoFolderOfTheBuild) {
  for (const auto& entry :
       fs::recursive_directory_iterator(installed_package() / "share/elastogen/cmake")) {
    const std::string text = selector::read_text_file(entry.path(), "package file");
    EXPECT_EQ(text.find(ELASTOGEN_SOURCE_DIR), std::string::npos) << entry.path();
  }
}

TEST(Package, HasAProgramThatFindsItsLaws) {
  const std::string listed =
      output_of({(installed_package() / "bin/elastogen").string(), "list", "--law", "stvk"});
  EXPECT_NE(listed.find("stvk  hexa8     q8"), std::string::npos) << listed;
}

/// clang++ where it can compile for OpenMP, else the compiler of this build: with both in the
/// tests, both compile the runtime and the kernels.
std::string another_compiler() {
  const selector::TemporaryFolder folder;
  const std::string source = (folder.path() / "openmp.cpp").string();
  selector::write_text_file(source, "#include <omp.h>\n");
  const bool has_clang =
      selector::find_program("clang++") &&
      selector::run_process({"clang++", "-fopenmp", "-fsyntax-only", source}).exit_status == 0;
  return has_clang ? "clang++" : CXX_COMPILER;
}

TEST(Subdirectory, BuildsWithoutGinacWithAnotherCompilerAndRunsTheExample) {
  const CmakeProject project(
      ELASTOGEN_SOURCE_DIR "/tests/consumer/subdirectory",
      {"-DELASTOGEN_SOURCE=" ELASTOGEN_SOURCE_DIR, "-DCMAKE_CXX_COMPILER=" + another_compiler(),
       "-DELASTOGEN_WERROR=ON", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG",
       "-DELASTOGEN_KERNEL_FLAGS=-O0;-Wno-psabi", "-DELASTOGEN_KERNEL_INSTRUCTION_SETS=native"});
  const std::string cache = selector::read_text_file(project.folder() / "CMakeCache.txt", "cache");
  for (const char* package : {"GINAC", "CLN", "VTK", "tomlplusplus", "CLI11", "GTest"}) {
    EXPECT_EQ(cache.find(package), std::string::npos) << package;
  }
  (void)project.build();
  expect_at_rest(output_of({(project.folder() / "time_loop/time_loop").string()}));
}

TEST(GeneratedFolder, IsWhatTheGeneratorWritesByteForByte) {
  const fs::path kept = ELASTOGEN_SOURCE_DIR "/generated";
  const selector::TemporaryFolder made;
  (void)output_of({ELASTOGEN_BINARY_DIR "/bin/elastogen", "--laws", ELASTOGEN_SOURCE_DIR "/laws",
                   "generate", "hooke-tet4-q1-none", "hooke-hexa8-q8-none", "stvk-tet4-q1-none",
                   "stvk-hexa8-q8-none", "--out", made.path().string()});
  std::size_t compared = 0;
  for (const auto& entry : fs::directory_iterator(made.path())) {
    const fs::path file = entry.path().filename();
    EXPECT_EQ(selector::read_text_file(entry.path(), "made"),
              selector::read_text_file(kept / file, "kept"))
        << file << ": cmake --build build --target regenerate";
    ++compared;
  }
  EXPECT_EQ(compared, 17U);  // four files of each association, and the manifest
}

}  // namespace
}  // namespace elastogen::test
