// Other programs, run to their end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace elastogen::selector {

struct ProcessResult {
  int exit_status = 0;  ///< meaningless when a signal ended the program
  int signal = 0;       ///< that ended it; 0: none
  std::string output;   ///< standard output and error, as they came
};

/// Runs a program, found in PATH unless its name has a slash, without a shell and without input.
/// @throws WorkError  when it cannot be started
[[nodiscard]] ProcessResult run_process(const std::vector<std::string>& command);

/// The file that a program's name means, as a shell would look it up.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace elastogen::selector
