// A CMake project of somebody else, configured and built in a temporary folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "selector/support/process.h"
#include "temporary_folder.h"

namespace elastogen::test {

class CmakeProject {
 public:
  /// Configures `source` with this build's generator and compiler, and `options` beside.
  CmakeProject(const std::filesystem::path& source, const std::vector<std::string>& options);

  /// Builds everything; returns what the build printed. A failure fails the test.
  [[nodiscard]] std::string build() const;

  [[nodiscard]] std::filesystem::path folder() const { return folder_.path() / "build"; }

 private:
  selector::TemporaryFolder folder_;
};

/// The package of this build, installed once for all tests of the program.
[[nodiscard]] const std::filesystem::path& installed_package();

/// Runs a program and returns its output. A failure fails the test.
[[nodiscard]] std::string output_of(const std::vector<std::string>& command);

}  // namespace elastogen::test
