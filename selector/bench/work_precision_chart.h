// The chart of one problem in the report on time against error.
#pragma once

#include <string>
#include <vector>

#include "selector/bench/pareto.h"
#include "selector/bench/svg_chart.h"
#include "selector/bench/work_precision_point.h"

namespace elastogen::selector {

/// The shape that stands for a law.
[[nodiscard]] Marker law_marker(const std::string& law);

/// Error against time, both logarithmic: a faint line joins the best points of each element and
/// law, the dark one is the Pareto front of all of elastogen. Errors above 100 % and below 1e-7
/// (beyond what references are good for) stand at the chart's edge. The chart of the solve has
/// elastogen's points alone.
///
/// @param points  of one problem; those without a figure are left out
/// @return        empty if there is nothing to draw
[[nodiscard]] std::string work_precision_chart(const std::vector<WorkPrecisionPoint>& points,
                                               const std::string& title, WorkTime time);

}  // namespace elastogen::selector
