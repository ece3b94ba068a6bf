// The page that shows time against error.
#pragma once

#include <string>
#include <vector>

#include "selector/bench/results_database.h"
#include "selector/bench/work_precision_point.h"

namespace elastogen::selector {

/// What a problem is to people.
struct ProblemText {
  std::string problem;   ///< as in the points
  std::string title;     ///< "Beam in bending"
  std::string text;      ///< geometry, material, load
  std::string quantity;  ///< what the error is of: "mean u_z of the end face against -0.60760 m"
};

/// A page in one file that needs nothing else, neither network nor script: for each problem the
/// sentences (pareto.h), a chart of error against the time of the whole process and one against
/// that of the solve, a table of the best points with their phases, and why points have no figure.
///
/// In the charts colour tells the element and shape the law; hollow points are CalculiX's. The line
/// is elastogen's Pareto front. Every point shows its figures under the mouse.
///
/// @param points    of all problems; those of problems not in `problems` are not shown
/// @param problems  in the order of the page; one without points is left out
/// @param run       the latest, whose machine and versions are named
/// @param sections  HTML that follows, such as those of thesis_sections.h
[[nodiscard]] std::string work_precision_html(const std::vector<WorkPrecisionPoint>& points,
                                              const std::vector<ProblemText>& problems,
                                              const BenchRun& run,
                                              const std::vector<std::string>& sections);

}  // namespace elastogen::selector
