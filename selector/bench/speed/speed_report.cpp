#include "selector/bench/speed/speed_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "selector/bench/element_look.h"
#include "selector/bench/svg_chart.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {
namespace {

/// "24 KiB", "3 MiB"
std::string size_text(std::size_t bytes) {
  constexpr std::size_t mega = std::size_t(1) << 20;
  return bytes < mega ? fmt::format("{} KiB", bytes >> 10) : fmt::format("{} MiB", bytes / mega);
}

std::string operation_text(const SpeedRecord& record) {
  return record.strategy.empty() ? record.operation
                                 : fmt::format("{} {}", record.operation, record.strategy);
}

double noise(const SpeedRecord& record) {
  return std::max(0.02, record.median / record.minimum - 1);
}

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

std::string html_table(const SpeedResults& results, const std::string& benchmark) {
  const bool on_mesh = benchmark == "operators";
  std::string text =
      "<div class=wide><table><thead><tr><th class=text>association</th>"
      "<th class=text>geometry</th><th class=text>precision</th>"
      "<th class=text>operation</th>";
  if (on_mesh) text += "<th class=text>mesh</th><th>elements</th><th>threads</th>";
  text += "<th>ns, least</th><th>median</th><th>flops</th><th>bytes</th><th>of peak</th>";
  if (on_mesh) text += "<th>of roofline</th><th>MDoF/s</th><th>bytes stored</th>";
  text += "</tr></thead>\n<tbody>";
  for (const SpeedRecord& r : results.records) {
    if (r.benchmark != benchmark) continue;
    text += fmt::format(
        "<tr><td>{}</td><td class=text>{}</td><td class=text>{}</td>"
        "<td class=text>{}</td>",
        html_text(r.association), r.geometry, r.precision, operation_text(r));
    if (on_mesh) {
      text += fmt::format("<td class=text>{}</td><td>{}</td><td>{}</td>", r.mesh, r.elements,
                          r.threads);
    }
    text += fmt::format(
        "<td>{:.3g}</td><td>{:.3g}</td><td>{:.0f}</td><td>{:.0f}</td>"
        "<td>{:.0f} %</td>",
        r.minimum, r.median, r.flops, r.bytes, 100 * r.of_peak);
    if (on_mesh) {
      text += fmt::format("<td>{:.0f} %</td><td>{:.0f}</td><td>{:.0f}</td>", 100 * r.of_roofline,
                          r.mdofs(), r.stored);
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace

std::string limits_text(const MachineLimits& limits) {
  std::string text;
  for (const PeakFlops& peak : limits.peaks) {
    text += fmt::format("multiply-adds, {}, {} {}: {:.1f} GFlop/s\n",
                        peak.single_precision ? "single" : "double", peak.threads,
                        peak.threads == 1 ? "thread" : "threads", peak.gigaflops);
  }
  for (const TriadBandwidth& triad : limits.triads) {
    text += fmt::format("triad, {}, {} {}: {:.1f} GB/s\n", size_text(triad.bytes), triad.threads,
                        triad.threads == 1 ? "thread" : "threads", triad.gigabytes_per_second);
  }
  return text;
}

std::string speed_table_head(const std::string& benchmark) {
  if (benchmark == "kernels") {
    return fmt::format("{:32} {:8} {:7} {:10} {:>9} {:>9} {:>7} {:>8}\n", "association", "geometry",
                       "scalar", "operation", "ns least", "median", "flops", "of peak");
  }
  return fmt::format(
      "{:28} {:8} {:7} {:10} {:>8} {:>2} {:19} {:>8} {:>8} {:>6} {:>7} {:>6} {:>6}\n",
      "association", "geometry", "scalar", "mesh", "elements", "th", "operation", "ns least",
      "median", "bytes", "of roof", "MDoF/s", "stored");
}

std::string speed_table_line(const SpeedRecord& r) {
  if (r.benchmark == "kernels") {
    return fmt::format("{:32} {:8} {:7} {:10} {:9.2f} {:9.2f} {:7.0f} {:6.0f} %\n", r.association,
                       r.geometry, r.precision, r.operation, r.minimum, r.median, r.flops,
                       100 * r.of_peak);
  }
  return fmt::format(
      "{:28} {:8} {:7} {:10} {:8} {:2} {:19} {:8.2f} {:8.2f} {:6.0f} {:5.0f} % {:6.0f} {:6.0f}\n",
      r.association, r.geometry, r.precision, r.mesh, r.elements, r.threads, operation_text(r),
      r.minimum, r.median, r.bytes, 100 * r.of_roofline, r.mdofs(), r.stored);
}

std::string speed_html(const SpeedResults& results) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width\">\n"
      "<title>Speed of kernels and operators</title>\n<style>{}</style></head>\n<body>\n"
      "<h1>Speed of kernels and operators</h1>\n{}"
      "<p>Grey lines are what the machine can do at most: the bandwidth of a triad over arrays of "
      "the size named, and the peak of multiply-adds, measured in the same run. A point under the "
      "mouse shows its figures. Times are the least of many samples, of the thread's processor "
      "time where there is one thread.</p>\n<pre class=quantity>{}</pre>\n",
      bench_page_style(), bench_run_html(results.run), html_text(limits_text(results.limits)));
  for (const std::string benchmark : {"kernels", "operators"}) {
    std::set<std::pair<int, std::string>> kinds;
    for (const SpeedRecord& record : results.records) {
      if (record.benchmark == benchmark) kinds.emplace(record.threads, record.precision);
    }
    if (kinds.empty()) continue;
    text += fmt::format("<h2>{}</h2>\n", benchmark == "kernels"
                                             ? "Kernels, operands in cache"
                                             : "Operators: gather, kernel, addition");
    for (const auto& [threads, precision] : kinds) {
      text += roofline(results, benchmark, threads, precision);
    }
    text += html_table(results, benchmark);
  }
  return text + "</body></html>\n";
}

std::string compare_speed(const SpeedResults& before, const SpeedResults& after) {
  std::map<std::string, const SpeedRecord*> old;
  for (const SpeedRecord& record : before.records) old[record.key()] = &record;
  std::string text;
  if (before.run.processor != after.run.processor) {
    text += fmt::format("the processors differ: {} and {}\n", before.run.processor,
                        after.run.processor);
  }
  struct Change {
    double ratio;
    std::string line;
  };
  std::vector<Change> changes;
  std::size_t unchanged = 0, added = 0;
  for (const SpeedRecord& record : after.records) {
    const auto found = old.find(record.key());
    if (found == old.end()) {
      ++added;
      continue;
    }
    const SpeedRecord& was = *found->second;
    old.erase(found);
    const double ratio = record.minimum / was.minimum;
    if (std::abs(std::log(ratio)) <= std::log1p(std::max(noise(was), noise(record)))) {
      ++unchanged;
      continue;
    }
    changes.push_back({ratio, fmt::format("{:6.3f} x  {:8.2f} -> {:8.2f} ns  {}\n", ratio,
                                          was.minimum, record.minimum, record.key())});
  }
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.ratio > b.ratio; });
  for (const Change& change : changes) text += change.line;
  return text + fmt::format("{} changed beyond noise, {} did not, {} only before, {} only after\n",
                            changes.size(), unchanged, old.size(), added);
}

}  // namespace elastogen::selector
