#include "selector/bench/speed/speed_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "selector/bench/element_look.h"
#include "selector/bench/speed/speed_table.h"
#include "selector/bench/svg_chart.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {
namespace {

/// Lines that nothing can pass: bandwidths up to the peak, then the peak.
void add_limits(const MachineLimits& limits, int threads, bool single, double low, double high,
                Chart& chart) {
  const double peak = limits.peak(single, threads);
  for (const TriadBandwidth& triad : limits.triads) {
    if (triad.threads != threads) continue;
    ChartSeries line;
    line.name = size_text(triad.bytes);
    line.colour = "#9aa1ab";
    line.marker = Marker::none;
    line.line = 1;
    const double ridge = std::clamp(peak / triad.gigabytes_per_second, low, high);
    for (const double x : {low, ridge, high}) {
      line.points.push_back({x, std::min(peak, x * triad.gigabytes_per_second),
                             fmt::format("{}: {:.1f} GB/s\npeak: {:.1f} GFlop/s", line.name,
                                         triad.gigabytes_per_second, peak)});
    }
    chart.series.push_back(line);
  }
}

std::string roofline(const SpeedResults& results, const std::string& benchmark, int threads,
                     const std::string& precision) {
  std::map<std::string, ChartSeries> of_element;
  double low = 0.1, high = 10;
  for (const SpeedRecord& record : results.records) {
    if (record.benchmark != benchmark || record.threads != threads ||
        record.precision != precision || record.flops == 0 || record.bytes == 0) {
      continue;
    }
    const std::string element = symgen::AssociationId::parse(record.association).element;
    ChartSeries& series = of_element[element];
    series.name = element;
    series.colour = element_colour(element);
    series.opacity = 0.8;
    const double intensity = record.flops / record.bytes;
    low = std::min(low, intensity / 1.5);
    high = std::max(high, intensity * 1.5);
    series.points.push_back(
        {intensity, record.flops / record.minimum,
         fmt::format("{}, {}\n{}{}\n{:.3g} ns, {:.0f} flops, {:.0f} bytes per element\n{:.0f} % "
                     "of the roofline",
                     record.association, record.geometry, operation_text(record),
                     record.mesh.empty()
                         ? ""
                         : fmt::format(", {} {} elements", record.elements, record.mesh),
                     record.minimum, record.flops, record.bytes, 100 * record.of_roofline)});
  }
  if (of_element.empty()) return {};
  Chart chart;
  chart.title = fmt::format("{} in {} precision, {} {}", benchmark, precision, threads,
                            threads == 1 ? "thread" : "threads");
  chart.x = {"flops per byte", true, TickFormat::number, low, high};
  chart.y = {"GFlop/s", true, TickFormat::number, {}, {}};
  add_limits(results.limits, threads, precision == "single", low, high, chart);
  for (auto& [element, series] : of_element) chart.series.push_back(std::move(series));
  return svg(chart);
}

/// Time per element against the number of elements: what stays level scales.
std::string scaling_chart(const SpeedResults& results, const std::string& association) {
  static const std::map<std::string, std::string> colours = {
      {"natural", "#2b6cb0"}, {"random", "#c05621"}, {"reordered", "#2f855a"}};
  std::map<std::string, ChartSeries> lines;
  for (const SpeedRecord& r : results.records) {
    if (r.benchmark != "scaling" || r.association != association) continue;
    const std::string name =
        fmt::format("{}, {}{}", operation_text(r), r.order,
                    r.threads == 1 ? "" : fmt::format(", {} threads", r.threads));
    ChartSeries& line = lines[name + r.mesh];
    line.name = name;
    line.colour = colours.at(r.order);
    line.marker = r.operation == "forces" ? Marker::circle : Marker::square;
    line.line = 1.5;
    line.dashed = r.threads > 1;
    line.points.push_back({static_cast<double>(r.elements), r.minimum,
                           fmt::format("{}\n{} {} elements\n{:.3g} ns per element", name,
                                       r.elements, r.mesh, r.minimum)});
  }
  Chart chart;
  chart.title = association;
  chart.x = {"elements", true, TickFormat::number, {}, {}};
  chart.y = {"ns per element", true, TickFormat::number, {}, {}};
  chart.legend_width = 340;
  for (auto& [name, line] : lines) chart.series.push_back(std::move(line));
  return svg(chart);
}

std::string scaling_charts(const SpeedResults& results) {
  std::set<std::string> associations;
  for (const SpeedRecord& record : results.records) {
    if (record.benchmark == "scaling") associations.insert(record.association);
  }
  std::string text;
  for (const std::string& association : associations) text += scaling_chart(results, association);
  return text;
}

std::string html_table(const SpeedResults& results, const std::string& benchmark) {
  std::string text = "<div class=wide><table><thead><tr>";
  const auto cell = [&](const char* tag, const SpeedColumn& column, const std::string& content) {
    text += fmt::format("<{}{}>{}</{}>", tag, column.is_text ? " class=text" : "",
                        html_text(content), tag);
  };
  for (const SpeedColumn& column : speed_columns(benchmark)) cell("th", column, column.head);
  text += "</tr></thead>\n<tbody>";
  for (const SpeedRecord& record : results.records) {
    if (record.benchmark != benchmark) continue;
    text += "<tr>";
    for (const SpeedColumn& column : speed_columns(benchmark)) {
      cell("td", column, column.text(record));
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

/// Rooflines for every number of threads and precision that a benchmark has.
std::string rooflines(const SpeedResults& results, const std::string& benchmark) {
  std::set<std::pair<int, std::string>> kinds;
  for (const SpeedRecord& record : results.records) {
    if (record.benchmark == benchmark) kinds.emplace(record.threads, record.precision);
  }
  std::string text;
  for (const auto& [threads, precision] : kinds) {
    text += roofline(results, benchmark, threads, precision);
  }
  return text;
}

}  // namespace

std::string speed_html(const SpeedResults& results) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width\">\n"
      "<title>Speed of kernels and operators</title>\n<style>{}</style></head>\n<body>\n"
      "<h1>Speed of kernels and operators</h1>\n{}"
      "<p>What the machine can do at most, the peak of multiply-adds and the bandwidth of a triad "
      "over arrays of the size named, was measured in the same run; where there are grey lines in "
      "a picture, they are these. A point under the mouse shows its figures. Times are the least "
      "of many samples, of the thread's processor time where there is one "
      "thread.</p>\n<pre class=quantity>{}</pre>\n",
      bench_page_style(), bench_run_html(results.run), html_text(limits_text(results.limits)));
  struct Section {
    const char* benchmark;
    const char* title;
    std::string charts;
  };
  for (const Section& section :
       {Section{"kernels", "Kernels, operands in cache", rooflines(results, "kernels")},
        Section{"operators", "Operators: gather, kernel, addition",
                rooflines(results, "operators")},
        Section{"scaling", "By size, order and threads", scaling_charts(results)},
        Section{"peers", "Beside other programs: ratios of their time to ours", ""}}) {
    const bool is_there = std::any_of(
        results.records.begin(), results.records.end(),
        [&](const SpeedRecord& record) { return record.benchmark == section.benchmark; });
    if (is_there) {
      text += fmt::format("<h2>{}</h2>\n{}{}", section.title, section.charts,
                          html_table(results, section.benchmark));
    }
  }
  return text + "</body></html>\n";
}

}  // namespace elastogen::selector
