// When, on what and by what something was measured.
#pragma once

#include <string>

namespace elastogen::selector {

/// One start of a benchmark.
struct BenchRun {
  std::string started;    ///< UTC, "2024-05-17T09:30:00Z"
  std::string processor;  ///< model of the CPU
  int cores = 0;          ///< that could be used
  std::string compiler;   ///< of the kernels, with its version and flags
  std::string version;    ///< of elastogen, with what tells builds apart
};

/// A run that starts now on this machine.
/// @throws WorkError  no compiler
[[nodiscard]] BenchRun start_bench_run(int cores);

/// The run in a line for a page, as HTML.
[[nodiscard]] std::string bench_run_html(const BenchRun& run);

/// Style sheet of the benchmarks' pages.
[[nodiscard]] const char* bench_page_style();

}  // namespace elastogen::selector
