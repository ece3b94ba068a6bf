// Other programs, run to their end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/error.h"

namespace elastogen::selector {

struct ProcessResult {
  int exit_status = 0;      ///< meaningless when a signal ended the program
  int signal = 0;           ///< that ended it; 0: none
  bool timed_out = false;   ///< it was killed because its time was over
  double wall_seconds = 0;  ///< from its start until it was waited for
  double cpu_seconds = 0;   ///< user and system time, with that of children it waited for
  std::string output;       ///< standard output and error, as they came
};

/// A program was stopped at its time limit.
class TookTooLong : public WorkError {
 public:
  using WorkError::WorkError;
};

/// How a program is run.
struct ProcessOptions {
  std::filesystem::path folder;  ///< its working directory; empty: ours
  std::vector<std::pair<std::string, std::string>> environment;  ///< set on top of ours
  double time_limit = 0;  ///< wall seconds, then it is killed; 0: none. Its children are not
};

/// Runs a program, found in PATH unless its name has a slash, without a shell and without input. A
/// relative name with a slash is looked up from our folder, not from `options.folder`. Ctrl-C at
/// the terminal reaches the program as well as us.
/// @throws WorkError  when it cannot be started
[[nodiscard]] ProcessResult run_process(const std::vector<std::string>& command,
                                        const ProcessOptions& options = {});

/// The file that a program's name means, as a shell would look it up.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace elastogen::selector
