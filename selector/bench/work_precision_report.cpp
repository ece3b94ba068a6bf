#include "selector/bench/work_precision_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "selector/bench/pareto.h"
#include "selector/bench/svg_chart.h"
#include "selector/bench/work_precision_chart.h"

namespace elastogen::selector {
namespace {

using Points = std::vector<WorkPrecisionPoint>;

struct Phase {
  const char* name;
  const char* colour;
  double WorkPrecisionPoint::*seconds;
};

constexpr std::array<Phase, 7> phases = {
    {{"mesh", "#b9c0c9", &WorkPrecisionPoint::mesh},
     {"kernels", "#8d7fc7", &WorkPrecisionPoint::kernels},
     {"setup", "#5aa9e6", &WorkPrecisionPoint::setup},
     {"linearization", "#35b8b0", &WorkPrecisionPoint::linearization},
     {"linear solve", "#e4572e", &WorkPrecisionPoint::linear_solve},
     {"forces", "#f2a922", &WorkPrecisionPoint::forces},
     {"output", "#d9cdb8", &WorkPrecisionPoint::output}}};

std::string seconds_text(double seconds) {
  return seconds > 0 ? figure_text(seconds, TickFormat::seconds) : std::string("–");
}

/// Without the points that are hardly better than the one before.
Points thinned(const Points& front) {
  Points kept;
  for (const WorkPrecisionPoint& point : front) {
    if (kept.empty() || point.error < 0.9 * kept.back().error) kept.push_back(point);
  }
  return kept;
}

std::string phase_bar(const WorkPrecisionPoint& point) {
  std::string bar = "<div class=bar>";
  for (const Phase& phase : phases) {
    const double share = 100 * point.*phase.seconds / point.process_seconds;
    if (!(share > 0)) continue;
    bar += fmt::format("<span style=\"width:{:.1f}%;background:{}\" title=\"{} {}\"></span>", share,
                       phase.colour, phase.name, seconds_text(point.*phase.seconds));
  }
  return bar + "</div>";
}

std::string front_table(const Points& front) {
  std::string text =
      "<div class=wide><table><thead><tr><th>error</th><th>whole process</th><th>solve</th>"
      "<th class=text>association</th><th class=text>resolution</th><th class=text>solver</th>"
      "<th>tolerance</th><th>dofs</th><th class=text>phases</th>";
  for (const Phase& phase : phases) text += fmt::format("<th>{}</th>", phase.name);
  text += "<th>CPU</th></tr></thead>\n<tbody>";
  for (const WorkPrecisionPoint& point : front) {
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=text>{}</td><td class=text>{}</td>"
        "<td class=text>{}</td><td>{:g}</td><td>{}</td><td>{}</td>",
        figure_text(point.error, TickFormat::percent), seconds_text(point.process_seconds),
        seconds_text(point.solve_seconds), html_text(point.association),
        html_text(point.resolution), html_text(point.solver_text()), point.tolerance,
        point.num_dofs, phase_bar(point));
    for (const Phase& phase : phases)
      text += fmt::format("<td>{}</td>", seconds_text(point.*phase.seconds));
    text += fmt::format("<td>{}</td></tr>\n", seconds_text(point.cpu_seconds));
  }
  text += "</tbody></table></div>\n<p class=\"key quantity\">Phases, of the whole process:";
  for (const Phase& phase : phases) {
    text += fmt::format(" <span style=\"background:{}\"></span>{}", phase.colour, phase.name);
  }
  return text +
         ". What is left is the start of the process. Points that lower the error by less "
         "than a tenth are left out.</p>\n";
}

std::string failures(const Points& points) {
  std::string list;
  std::size_t count = 0;
  for (const WorkPrecisionPoint& point : points) {
    if (point.succeeded()) continue;
    ++count;
    list += fmt::format("<li>{}, {}, {}, tolerance {:g}: {}</li>\n", html_text(point.association),
                        html_text(point.resolution), html_text(point.solver_text()),
                        point.tolerance, html_text(point.failure));
  }
  if (count == 0) return {};
  return fmt::format("<details><summary>{} {} no figure</summary><ul>\n{}</ul></details>\n", count,
                     count == 1 ? "point has" : "points have", list);
}

/// With figures that stay on one line with their "%".
std::string unbroken(std::string text) {
  for (std::size_t at = 0; (at = text.find(" %", at)) != std::string::npos;)
    text.replace(at, 1, "&nbsp;");
  return text;
}

std::string problem_section(const ProblemText& problem, const Points& points) {
  std::string text =
      fmt::format("<h2>{}</h2>\n<p>{}</p>\n<p class=quantity>Error: {}.</p>\n<ul>\n",
                  html_text(problem.title), html_text(problem.text), html_text(problem.quantity));
  for (const std::string& sentence : work_precision_sentences(points))
    text += fmt::format("<li>{}</li>\n", unbroken(html_text(sentence)));
  text += "</ul>\n";
  text += work_precision_chart(points, problem.title + ": whole process", WorkTime::process);
  text += work_precision_chart(points, problem.title + ": setup and solve alone", WorkTime::solve);

  Points ours;
  std::copy_if(points.begin(), points.end(), std::back_inserter(ours),
               [](const WorkPrecisionPoint& point) { return point.program != "calculix"; });
  const Points front = pareto_front(ours, WorkTime::process);
  if (!front.empty()) text += "<h3>Points of the Pareto front</h3>\n" + front_table(thinned(front));
  return text + failures(points);
}

}  // namespace

std::string work_precision_html(const Points& points, const std::vector<ProblemText>& problems,
                                const BenchRun& run, const std::vector<std::string>& sections) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width\">\n"
      "<title>Time against error</title>\n<style>{}</style></head>\n<body>\n"
      "<h1>Time against error</h1>\n"
      "{}"
      "<p>Each point is one process, from its start to its end; times are medians of its runs. "
      "Colour tells the element, shape the law; hollow points are CalculiX’s. Large points are "
      "the best of their element and law, the dark line is the Pareto front: no other point of "
      "elastogen has both less time and less error. A point under the mouse shows its "
      "figures.</p>\n",
      bench_page_style(), bench_run_html(run));
  for (const ProblemText& problem : problems) {
    Points its_points;
    std::copy_if(points.begin(), points.end(), std::back_inserter(its_points),
                 [&](const WorkPrecisionPoint& point) { return point.problem == problem.problem; });
    if (!its_points.empty()) text += problem_section(problem, its_points);
  }
  for (const std::string& section : sections) text += section;
  return text + "</body></html>\n";
}

}  // namespace elastogen::selector
