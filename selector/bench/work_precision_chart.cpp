#include "selector/bench/work_precision_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "selector/bench/element_look.h"

namespace elastogen::selector {
namespace {

using Points = std::vector<WorkPrecisionPoint>;

constexpr double least_error = 1e-7, greatest_error = 1;

struct Look {
  bool calculix = false;
  std::string element;
  std::string law;
  auto operator<=>(const Look&) const = default;
};

std::string hover_text(const WorkPrecisionPoint& point) {
  std::string text = fmt::format(
      "{}{}\n{}, {}, tolerance {:g}\nerror {}\nwhole process {}", point.association,
      point.program == "calculix" ? " (CalculiX)" : "", point.resolution, point.solver_text(),
      point.tolerance, figure_text(point.error, TickFormat::percent),
      figure_text(point.process_seconds, TickFormat::seconds));
  if (point.solve_seconds > 0) {
    text += fmt::format(", solve {}", figure_text(point.solve_seconds, TickFormat::seconds));
  }
  return text +
         fmt::format("\n{} elements, {} degrees of freedom", point.num_elements, point.num_dofs);
}

ChartPoint chart_point(const WorkPrecisionPoint& point, WorkTime time) {
  return {seconds_of(point, time), std::clamp(point.error, least_error, greatest_error),
          hover_text(point)};
}

bool same(const WorkPrecisionPoint& a, const WorkPrecisionPoint& b) {
  const auto key = [](const WorkPrecisionPoint& p) {
    return std::tie(p.program, p.association, p.resolution, p.solver, p.precision, p.tolerance);
  };
  return key(a) == key(b);
}

/// Points of one look: those on its front with a line, the others small and faint.
void add_series(Chart& chart, const Look& look, const Points& points, WorkTime time) {
  const Points front = pareto_front(points, time);
  ChartSeries best;
  best.colour = element_colour(look.element);
  best.marker = law_marker(look.law);
  best.filled = !look.calculix;
  ChartSeries others = best;
  best.line = 1.2;
  best.line_opacity = 0.6;
  best.dashed = look.calculix;
  others.size = 3.2;
  others.opacity = 0.45;
  for (const WorkPrecisionPoint& point : front) best.points.push_back(chart_point(point, time));
  for (const WorkPrecisionPoint& point : points) {
    const bool on_front = std::any_of(front.begin(), front.end(),
                                      [&](const auto& other) { return same(point, other); });
    if (!on_front && point.succeeded() && seconds_of(point, time) > 0)
      others.points.push_back(chart_point(point, time));
  }
  chart.series.push_back(std::move(others));
  chart.series.push_back(std::move(best));
}

/// Entries that explain colour, shape and lines.
void add_legend(Chart& chart, const std::set<Look>& looks) {
  ChartSeries entry;
  entry.name = "Pareto front";
  entry.colour = "#22262b";
  entry.marker = Marker::none;
  entry.line = 2.2;
  chart.series.push_back(entry);
  entry.line = 0;
  std::set<std::string> elements, calculix, laws;
  for (const Look& look : looks) {
    (look.calculix ? calculix : elements).insert(look.element);
    laws.insert(look.law);
  }
  entry.marker = Marker::circle;
  for (const std::string& element : elements) {
    entry.name = element;
    entry.colour = element_colour(element);
    chart.series.push_back(entry);
  }
  entry.filled = false;
  entry.line = 1.2;
  entry.dashed = true;
  for (const std::string& element : calculix) {
    entry.name = "CalculiX " + element;
    entry.colour = element_colour(element);
    chart.series.push_back(entry);
  }
  entry.line = 0;
  entry.filled = true;
  entry.colour = "#6b7078";
  for (const std::string& law : laws) {
    entry.name = law;
    entry.marker = law_marker(law);
    chart.series.push_back(entry);
  }
}

}  // namespace

Marker law_marker(const std::string& law) {
  if (law.starts_with("stvk")) return Marker::circle;
  if (law.starts_with("hooke")) return Marker::square;
  if (law.starts_with("neo")) return Marker::triangle;
  if (law.starts_with("corot")) return Marker::inverted_triangle;
  return Marker::diamond;
}

std::string work_precision_chart(const Points& points, const std::string& title, WorkTime time) {
  std::map<Look, Points> by_look;
  Points ours;
  for (const WorkPrecisionPoint& point : points) {
    if (!point.succeeded() || !std::isfinite(point.error) || seconds_of(point, time) <= 0) continue;
    const bool calculix = point.program == "calculix";
    by_look[{calculix, point.element, point.law}].push_back(point);
    if (!calculix) ours.push_back(point);
  }
  if (by_look.empty()) return {};

  Chart chart;
  chart.title = title;
  chart.height = 540;
  chart.legend_width = 165;
  chart.x = {
      time == WorkTime::process ? "wall time of the whole process" : "wall time of setup and solve",
      true,
      TickFormat::seconds,
      {},
      {}};
  chart.y = {"relative error", true, TickFormat::percent, {}, {}};
  std::set<Look> looks;
  for (const auto& [look, its_points] : by_look) looks.insert(look);
  add_legend(chart, looks);

  for (const auto& [look, its_points] : by_look) add_series(chart, look, its_points, time);
  ChartSeries front;
  front.colour = "#22262b";
  front.marker = Marker::none;
  front.line = 2.2;
  for (const WorkPrecisionPoint& point : pareto_front(ours, time))
    front.points.push_back(chart_point(point, time));
  chart.series.push_back(std::move(front));
  return svg(chart);
}

}  // namespace elastogen::selector
