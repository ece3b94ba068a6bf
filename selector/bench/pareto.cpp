#include "selector/bench/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "selector/bench/svg_chart.h"

namespace elastogen::selector {
namespace {

using Points = std::vector<WorkPrecisionPoint>;

bool counts(const WorkPrecisionPoint& point, WorkTime time) {
  return point.succeeded() && std::isfinite(point.error) && point.error >= 0 &&
         seconds_of(point, time) > 0;
}

Points select(const Points& points, const std::string& law, bool calculix) {
  Points selected;
  for (const WorkPrecisionPoint& point : points) {
    if (point.law == law && (point.program == "calculix") == calculix) selected.push_back(point);
  }
  return selected;
}

std::string seconds_text(double seconds) { return figure_text(seconds, TickFormat::seconds); }
std::string error_text(double error) { return figure_text(error, TickFormat::percent); }

/// "2.4 times as long", "0.8 of the time"
std::string ratio_text(double ratio) {
  return ratio >= 1 ? fmt::format("{:.2g} times as long", ratio)
                    : fmt::format("{:.2g} of the time", ratio);
}

/// What stands after "reached by no measured point".
std::string least_error_text(const Points& points) {
  const Points front = pareto_front(points, WorkTime::process);
  if (front.empty()) return ".";
  const WorkPrecisionPoint& best = front.back();
  return fmt::format("; elastogen's least error is {}: {}, {}, {}.", error_text(best.error),
                     best.association, best.resolution, seconds_text(best.process_seconds));
}

std::string calculix_text(const Points& calculix, const std::optional<WorkPrecisionPoint>& ours,
                          double error) {
  const auto theirs = fastest_for(calculix, error, WorkTime::process);
  if (!theirs) return " CalculiX does not reach it.";
  std::string text =
      fmt::format(" CalculiX: {}, {}: {}, error {}", theirs->element, theirs->resolution,
                  seconds_text(theirs->process_seconds), error_text(theirs->error));
  if (!ours) return text + ".";
  text += fmt::format(" ({}).", ratio_text(theirs->process_seconds / ours->process_seconds));
  if (std::abs(theirs->error / ours->error - 1) < 0.05) return text;  // it is the same error
  const auto same = interpolated_time(calculix, ours->error);
  if (!same) {
    return text + fmt::format(" It does not reach our {}.", error_text(ours->error));
  }
  return text + fmt::format(" At our error of {} it takes {} ({}, between its points): {}.",
                            error_text(ours->error), seconds_text(same->seconds), same->element,
                            ratio_text(same->seconds / ours->process_seconds));
}

}  // namespace

double seconds_of(const WorkPrecisionPoint& point, WorkTime time) {
  return time == WorkTime::process ? point.process_seconds : point.solve_seconds;
}

Points pareto_front(const Points& points, WorkTime time) {
  Points sorted;
  std::copy_if(points.begin(), points.end(), std::back_inserter(sorted),
               [&](const WorkPrecisionPoint& point) { return counts(point, time); });
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    const double t = seconds_of(a, time), s = seconds_of(b, time);
    return t != s ? t < s : a.error < b.error;
  });
  Points front;
  for (const WorkPrecisionPoint& point : sorted) {
    if (front.empty() || point.error < front.back().error) front.push_back(point);
  }
  return front;
}

std::optional<WorkPrecisionPoint> fastest_for(const Points& points, double error, WorkTime time) {
  for (const WorkPrecisionPoint& point : pareto_front(points, time)) {
    if (point.error <= error) return point;
  }
  return std::nullopt;
}

std::optional<InterpolatedTime> interpolated_time(const Points& points, double error) {
  std::map<std::string, Points> of_element;
  for (const WorkPrecisionPoint& point : points) of_element[point.element].push_back(point);
  std::optional<InterpolatedTime> best;
  for (const auto& [element, its_points] : of_element) {
    const Points front = pareto_front(its_points, WorkTime::process);
    for (std::size_t i = 0; i < front.size(); ++i) {
      if (front[i].error > error) continue;
      double seconds = front[i].process_seconds;
      // An error of exactly 0 has no logarithm; then the point itself is the nearest.
      if (i > 0 && front[i].error > 0) {
        const WorkPrecisionPoint &before = front[i - 1], &after = front[i];
        const double share = std::log(before.error / error) / std::log(before.error / after.error);
        seconds = before.process_seconds *
                  std::pow(after.process_seconds / before.process_seconds, share);
      }
      if (!best || seconds < best->seconds) best = InterpolatedTime{seconds, element};
      break;
    }
  }
  return best;
}

std::vector<std::string> work_precision_sentences(const Points& points) {
  std::set<std::string> laws;
  for (const WorkPrecisionPoint& point : points) laws.insert(point.law);
  std::vector<std::string> sentences;
  for (const std::string& law : laws) {
    const Points ours = select(points, law, false), calculix = select(points, law, true);
    if (ours.empty()) continue;
    for (const double error : {1e-2, 1e-3, 1e-4}) {
      const auto fastest = fastest_for(ours, error, WorkTime::process);
      std::string sentence = fmt::format("{}, for {}: ", law, error_text(error));
      if (fastest) {
        sentence += fmt::format("fastest is {}, {}, {}: {} whole process ({} solve), error {}.",
                                fastest->association, fastest->resolution, fastest->solver_text(),
                                seconds_text(fastest->process_seconds),
                                seconds_text(fastest->solve_seconds), error_text(fastest->error));
      } else if (calculix.empty() || !fastest_for(calculix, error, WorkTime::process)) {
        sentences.push_back(sentence + "reached by no measured point" + least_error_text(ours));
        break;  // nor are the smaller errors
      } else {
        sentence += "reached by no measured point of elastogen" + least_error_text(ours);
      }
      if (!calculix.empty()) sentence += calculix_text(calculix, fastest, error);
      sentences.push_back(sentence);
    }
  }
  return sentences;
}

}  // namespace elastogen::selector
