// The thesis's beams, computed: its tables 6.6 and 6.7, its figures 6.12 to 6.16.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "selector/bench/scene_process.h"

namespace elastogen::selector {

struct ThesisBeams {
  std::filesystem::path folder;  ///< where results are kept, and found again
  SceneProcess process;          ///< its folder of results is not used
  std::function<void(const std::string&)> tell;
  std::function<bool()> interrupted;
};

/// Runs the beams of four elements at the thesis's four resolutions, a converged one, and the
/// torsion by half a turn, unless the folder has them, and gives the sections of the page
/// (thesis_sections.h); none when interrupted.
/// @throws WorkError  a run that failed
[[nodiscard]] std::vector<std::string> thesis_sections_of(const ThesisBeams& beams);

}  // namespace elastogen::selector
