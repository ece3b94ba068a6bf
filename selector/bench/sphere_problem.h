// A thick sphere under pressure, at small and at large strain.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "selector/bench/work_precision_problem.h"

namespace elastogen::selector {

/// Radii 1 m and 2 m, E = 1 MPa, nu = 0.3, pressure from inside. Error: of the displacement over
/// all nodes, root of the mean square over that of the exact displacement (radial_sphere.h).
/// @param large  at a pressure that widens the inner surface by about a half; else by 0.8 %
[[nodiscard]] std::unique_ptr<WorkPrecisionProblem> make_sphere_problem(
    bool large, std::vector<std::filesystem::path> law_folders);

}  // namespace elastogen::selector
