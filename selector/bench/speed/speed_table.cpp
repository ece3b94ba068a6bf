#include "selector/bench/speed/speed_table.h"

#include <fmt/format.h>

namespace elastogen::selector {
namespace {

using Record = const SpeedRecord&;
using Columns = std::vector<SpeedColumn>;

const SpeedColumn association = {"association", 25, true, [](Record r) { return r.association; }};
const SpeedColumn geometry = {"geometry", 8, true, [](Record r) { return r.geometry; }};
const SpeedColumn scalar = {"scalar", 6, true, [](Record r) { return r.precision; }};
const SpeedColumn operation = {"operation", 18, true, operation_text};
const SpeedColumn mesh = {"mesh", 10, true, [](Record r) { return r.mesh; }};
const SpeedColumn order = {"order", 9, true, [](Record r) { return r.order; }};
const SpeedColumn elements = {"elements", 8, false,
                              [](Record r) { return fmt::format("{}", r.elements); }};
const SpeedColumn threads = {"threads", 7, false,
                             [](Record r) { return fmt::format("{}", r.threads); }};
const SpeedColumn least = {"ns, least", 9, false,
                           [](Record r) { return fmt::format("{:.2f}", r.minimum); }};
const SpeedColumn median = {"median", 8, false,
                            [](Record r) { return fmt::format("{:.2f}", r.median); }};
const SpeedColumn flops = {"flops", 6, false,
                           [](Record r) { return fmt::format("{:.0f}", r.flops); }};
const SpeedColumn bytes = {"bytes", 6, false,
                           [](Record r) { return fmt::format("{:.0f}", r.bytes); }};
const SpeedColumn stored = {"stored", 6, false,
                            [](Record r) { return fmt::format("{:.0f}", r.stored); }};
const SpeedColumn of_peak = {"of peak", 7, false,
                             [](Record r) { return fmt::format("{:.0f} %", 100 * r.of_peak); }};
const SpeedColumn of_roofline = {
    "of roof", 7, false, [](Record r) { return fmt::format("{:.0f} %", 100 * r.of_roofline); }};
const SpeedColumn mdofs = {"MDoF/s", 6, false,
                           [](Record r) { return fmt::format("{:.0f}", r.mdofs()); }};
const SpeedColumn program = {"program", 17, true, [](Record r) {
                               return r.peer.empty() ? std::string("elastogen") : r.peer;
                             }};
/// What elastogen has no figure of its own for has no ratio.
std::string ratio_text(Record r) {
  return r.ratio > 0 ? fmt::format("{:.2f} x", r.ratio) : std::string();
}
std::string ratios_text(Record r) {
  return r.ratio > 0 ? fmt::format("{:.2f}, {:.2f}", r.ratio_least, r.ratio_most) : std::string();
}

const SpeedColumn ratio = {"ratio", 7, false, ratio_text};
const SpeedColumn ratios = {"least, most", 13, false, ratios_text};
const SpeedColumn difference = {
    "differs", 8, false,
    [](Record r) { return r.peer.empty() ? std::string() : fmt::format("{:.0e}", r.difference); }};

/// A line of what `text` gives for each column.
template <class Text>
std::string table_line(const std::string& benchmark, const Text& text) {
  std::string line;
  for (const SpeedColumn& column : speed_columns(benchmark)) {
    line += column.is_text ? fmt::format("{:<{}} ", text(column), column.width)
                           : fmt::format("{:>{}} ", text(column), column.width);
  }
  line.back() = '\n';
  return line;
}

}  // namespace

const Columns& speed_columns(const std::string& benchmark) {
  static const Columns kernels = {association, geometry, scalar, operation,
                                  least,       median,   flops,  of_peak};
  static const Columns operators = {association, geometry,  scalar, mesh,   elements,
                                    threads,     operation, least,  median, bytes,
                                    of_roofline, mdofs,     stored};
  static const Columns scaling = {association, mesh,  elements, order,       threads,
                                  operation,   least, median,   of_roofline, mdofs};
  static const Columns peers = {association, mesh,   elements, operation, program,
                                least,       median, ratio,    ratios,    difference};
  if (benchmark == "kernels") return kernels;
  if (benchmark == "operators") return operators;
  return benchmark == "scaling" ? scaling : peers;
}

std::string speed_table_head(const std::string& benchmark) {
  return table_line(benchmark, [](const SpeedColumn& column) { return column.head; });
}

std::string speed_table_line(const SpeedRecord& record) {
  return table_line(record.benchmark,
                    [&](const SpeedColumn& column) { return column.text(record); });
}

std::string size_text(std::size_t bytes) {
  constexpr std::size_t mega = std::size_t(1) << 20;
  return bytes < mega ? fmt::format("{} KiB", bytes >> 10) : fmt::format("{} MiB", bytes / mega);
}

std::string operation_text(const SpeedRecord& record) {
  return record.strategy.empty() ? record.operation
                                 : fmt::format("{} {}", record.operation, record.strategy);
}

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

}  // namespace elastogen::selector
