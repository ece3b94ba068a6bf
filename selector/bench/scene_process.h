// Scenes run by this program as a process of its own, and timed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "selector/bench/work_precision_point.h"
#include "selector/bench/work_precision_problem.h"

namespace elastogen::selector {

/// A run that takes longer is not repeated for its median.
inline constexpr double long_run_seconds = 2;

/// How scenes are run.
struct SceneProcess {
  std::filesystem::path results;  ///< folder for a run's results, overwritten
  int threads = 1;
  int runs = 3;           ///< for the median; one where a run takes over two seconds
  double time_limit = 0;  ///< of a run [s]; 0: none
  /// Run once more before, without a limit: kernels are compiled then, which may take long.
  bool makes_kernels = false;
  std::vector<std::filesystem::path> law_folders;  ///< passed on as --laws
};

/// Runs a scene as often as asked, and fills in the point's counts, times and runs.
/// @throws WorkError  the run failed, with the end of what it said; TookTooLong at the limit
[[nodiscard]] SolvedScene run_scene(const std::filesystem::path& scene, const SceneProcess& how,
                                    WorkPrecisionPoint& point);

/// What an earlier run left in a folder.
[[nodiscard]] SolvedScene read_solved_scene(const std::filesystem::path& folder);

}  // namespace elastogen::selector
