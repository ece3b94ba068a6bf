#include "selector/bench/bench_run.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "selector/bench/svg_chart.h"
#include "selector/jit/compiler.h"

namespace elastogen::selector {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #22262b; background: #fff;
       max-width: 1320px; margin: 2rem auto; padding: 0 1rem; }
p, ul { max-width: 900px; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; }
h2 { font-size: 1.3rem; margin-top: 2.6rem; border-bottom: 1px solid #dcdfe4;
     padding-bottom: .2rem; }
h3 { font-size: 1.05rem; margin-top: 1.8rem; }
.machine, .quantity, figcaption { color: #5b6169; font-size: 13px; }
svg.chart { width: 100%; height: auto; display: block; margin: 1rem 0; }
svg .mark:hover { stroke: #111; stroke-width: 2; opacity: 1; }
.wide { overflow-x: auto; }
.pair { display: flex; flex-wrap: wrap; gap: .5rem; }
.pair svg.chart { flex: 1 1 480px; }
th.group { text-align: center; }
table { border-collapse: collapse; font-size: 12.5px; margin: .8rem 0;
        font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .55rem; text-align: right; border-bottom: 1px solid #e9ebee;
         white-space: nowrap; }
th { color: #5b6169; font-weight: 600; vertical-align: bottom; }
td:first-child, th:first-child, td.text, th.text { text-align: left; }
tr.ours { background: #f3f8ff; }
.bar { display: flex; width: 120px; height: 10px; background: #eef0f3; }
.bar span { height: 100%; }
.key span { display: inline-block; width: 10px; height: 10px; margin: 0 .3rem 0 .9rem; }
details { font-size: 13px; color: #5b6169; }
)";

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

BenchRun start_bench_run(int cores) {
  const Compiler compiler = find_compiler();
  const std::string version = compiler.version.substr(0, compiler.version.find('\n'));
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return {
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(now))),
      processor_name(), cores, fmt::format("{} {}", version, fmt::join(compiler.flags, " ")),
      ELASTOGEN_VERSION};
}

std::string bench_run_html(const BenchRun& run) {
  return fmt::format("<p class=machine>{} · {} · {} {} · {} · {}</p>\n", html_text(run.started),
                     html_text(run.processor), run.cores, run.cores == 1 ? "core" : "cores",
                     html_text("elastogen " + run.version), html_text(run.compiler));
}

const char* bench_page_style() { return style; }

}  // namespace elastogen::selector
