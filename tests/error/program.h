// The built program as a subprocess.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "selector/support/files.h"
#include "selector/support/process.h"
#include "temporary_folder.h"

namespace elastogen::selector {

/// Runs `elastogen` in a folder of the test's own.
class ProgramTest : public ::testing::Test {
 protected:
  /// @param environment  options of `env`, then "NAME=value"
  ProcessResult elastogen(std::vector<std::string> arguments,
                          const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> command = {"env", "-C", folder().string()};
    command.insert(command.end(), environment.begin(), environment.end());
    command.push_back("ELASTOGEN_CACHE_DIR=" + (folder() / "cache").string());
    command.push_back(ELASTOGEN_BINARY_DIR "/bin/elastogen");
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_process(command);
  }

  /// The call fails with the status, one `error:` that mentions the words, and makes no file.
  void expect_error(int status, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& words,
                    const std::vector<std::string>& environment = {}) const {
    const std::vector<std::string> before = files();
    const ProcessResult result = elastogen(arguments, environment);
    EXPECT_EQ(result.signal, 0);
    EXPECT_EQ(result.exit_status, status) << result.output;
    EXPECT_NE(result.output.find("error: "), std::string::npos) << result.output;
    for (const std::string& word : words) {
      EXPECT_NE(result.output.find(word), std::string::npos)
          << "'" << word << "' in: " << result.output;
    }
    EXPECT_EQ(files(), before);
  }

  void write(const std::string& name, const std::string& text) const {
    write_text_file(folder() / name, text);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  /// All files and folders, apart from the cache's.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
      const std::string name = entry.path().lexically_relative(folder()).string();
      if (!name.starts_with("cache")) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TemporaryFolder folder_;
};

}  // namespace elastogen::selector
