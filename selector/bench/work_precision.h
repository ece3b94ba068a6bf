// The benchmark of time against error: runs the points, keeps them, shows them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "selector/bench/work_precision_problem.h"

namespace elastogen::selector {

struct WorkPrecisionOptions {
  std::filesystem::path out;          ///< folder of results
  std::vector<std::string> problems;  ///< names; empty: all
  WorkPrecisionSelection selection;
  bool calculix = true;    ///< where it is installed
  bool thesis = true;      ///< the thesis's tables and figures, too, where bending is run
  int threads = 1;         ///< of every program
  int runs = 3;            ///< of a point, for its median; one where a run takes over two seconds
  double time_limit = 60;  ///< of a run [s]; finer meshes of a choice that took longer are left out
  std::vector<std::filesystem::path> law_folders;
  std::function<void(const std::string&)> tell;  ///< progress
  std::function<bool()> interrupted;
};

enum class WorkPrecisionStatus { complete, interrupted };

struct WorkPrecisionOutcome {
  WorkPrecisionStatus status = WorkPrecisionStatus::complete;
  std::size_t measured = 0, kept = 0,
              failed = 0;              ///< points: new, from earlier runs, without error
  std::vector<std::string> sentences;  ///< with the problem's title before them
  std::filesystem::path page;
};

/// Runs every point as a process of this program, one after the other; what the database in the
/// folder has is not run again. Writes scenes/, work_precision.sqlite, .csv and .html.
/// @throws InputError, WorkError  wrong names; a folder that cannot be written; no result of a
///                                reference
[[nodiscard]] WorkPrecisionOutcome run_work_precision(const WorkPrecisionOptions& options);

}  // namespace elastogen::selector
