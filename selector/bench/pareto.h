// What points of time against error say: the best of them, and who is how much faster.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "selector/bench/work_precision_point.h"

namespace elastogen::selector {

/// The time that counts.
enum class WorkTime {
  process,  ///< of the whole process: what a user waits for
  solve     ///< setup and solve: what a simulator that links the runtime pays
};

/// [s]; 0 where it was not measured (the solve of CalculiX)
[[nodiscard]] double seconds_of(const WorkPrecisionPoint& point, WorkTime time);

/// Points for which no other has both less time and less error: the fastest for every error, time
/// rising and error falling strictly. Points that failed, or whose time was not measured, are left
/// out.
[[nodiscard]] std::vector<WorkPrecisionPoint> pareto_front(
    const std::vector<WorkPrecisionPoint>& points, WorkTime time);

/// The point of least time among those of at most that error; none if there is none.
[[nodiscard]] std::optional<WorkPrecisionPoint> fastest_for(
    const std::vector<WorkPrecisionPoint>& points, double error, WorkTime time);

/// Time for an error between measured points.
struct InterpolatedTime {
  double seconds = 0;   ///< of the whole process
  std::string element;  ///< whose curve it is on
};

/// The least time for an error on the curves of the elements: the curve of an element goes straight
/// in the logarithms of time and error through its Pareto front. It ends there: an error above that
/// of its fastest point costs that point's time, one below that of its best has none.
/// @return  none if no element reaches the error
[[nodiscard]] std::optional<InterpolatedTime> interpolated_time(
    const std::vector<WorkPrecisionPoint>& points, double error);

/// One sentence for each law and each of the errors 1 %, 0.1 % and 0.01 %: which association,
/// resolution and solver of elastogen reaches it first, and how long CalculiX takes for it and for
/// the same error (`interpolated_time`) where it was measured with that law. The first error that
/// nobody reaches ends the list of its law.
///
/// @param points  of one problem
[[nodiscard]] std::vector<std::string> work_precision_sentences(
    const std::vector<WorkPrecisionPoint>& points);

}  // namespace elastogen::selector
