#include "cmake_project.h"

#include <gtest/gtest.h>

namespace elastogen::test {

using selector::ProcessResult;
using selector::run_process;

std::string output_of(const std::vector<std::string>& command) {
  const ProcessResult result = run_process(command);
  EXPECT_EQ(result.exit_status, 0) << result.output;
  return result.output;
}

CmakeProject::CmakeProject(const std::filesystem::path& source,
                           const std::vector<std::string>& options) {
  std::vector<std::string> command = {
      CMAKE_PROGRAM,   "-G", BUILD_GENERATOR,   "-S",
      source.string(), "-B", folder().string(), "-DCMAKE_CXX_COMPILER=" CXX_COMPILER};
  command.insert(command.end(), options.begin(), options.end());
  (void)output_of(command);
}

std::string CmakeProject::build() const {
  return output_of({CMAKE_PROGRAM, "--build", folder().string()});
}

const std::filesystem::path& installed_package() {
  static const selector::TemporaryFolder prefix;
  static const bool installed = [] {
    (void)output_of(
        {CMAKE_PROGRAM, "--install", ELASTOGEN_BINARY_DIR, "--prefix", prefix.path().string()});
    return true;
  }();
  (void)installed;
  return prefix.path();
}

}  // namespace elastogen::test
