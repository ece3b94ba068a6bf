// Instructions of kernels and passes against kept counts. With ELASTOGEN_UPDATE_COUNTS=1 the counts
// are kept anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "selector/support/process.h"

namespace elastogen::selector {
namespace {

/// Beyond it a count is a failure: compilers of one version still differ in small things.
constexpr double slack = 0.03;

struct CountedKernel {
  std::string association, geometry, operation, part;
  [[nodiscard]] std::string name() const {
    return fmt::format("{} {} {} {}", association, geometry, operation, part);
  }
};

std::vector<CountedKernel> counted_kernels() {
  std::vector<CountedKernel> all;
  for (const std::string law : {"hooke", "stvk"}) {
    for (const char* operation : {"forces", "product"}) {
      for (const char* part : {"kernel", "pass"}) {
        all.push_back({law + "-tet4-q1-none", "general", operation, part});
      }
      for (const char* geometry : {"general", "box"}) {
        all.push_back({law + "-hexa8-q8-none", geometry, operation, "kernel"});
      }
    }
  }
  return all;
}

/// Lines "ASSOCIATION GEOMETRY OPERATION PART COUNT".
std::map<std::string, long> read_kept_counts() {
  std::map<std::string, long> counts;
  std::ifstream file(KEPT_COUNTS);
  CountedKernel kernel;
  long count = 0;
  while (file >> kernel.association >> kernel.geometry >> kernel.operation >> kernel.part >>
         count) {
    counts[kernel.name()] = count;
  }
  return counts;
}

/// Instructions inside the functions whose names begin with "counted".
long count_instructions(const CountedKernel& kernel) {
  const ProcessResult result = run_process(
      {"valgrind", "--tool=callgrind", "--collect-atstart=no",
       "--toggle-collect=counted_" + kernel.part, "--callgrind-out-file=/dev/null", COUNT_KERNEL,
       kernel.association, kernel.geometry, kernel.operation, kernel.part});
  const std::string label = "Collected : ";
  const std::size_t at = result.output.find(label);
  if (result.exit_status != 0 || at == std::string::npos) {
    ADD_FAILURE() << kernel.name() << ": " << result.output;
    return 0;
  }
  return std::stol(result.output.substr(at + label.size()));
}

TEST(Instructions, AreNoMoreThanTheKeptCounts) {
  if (!find_program("valgrind")) GTEST_SKIP() << "valgrind is not installed";
  if (__GNUC__ != 12 || std::string(__VERSION__).find("clang") != std::string::npos) {
    GTEST_SKIP() << "the kept counts are of g++ 12";
  }
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "the kernels are compiled for AVX2";
  const bool keeps = std::getenv("ELASTOGEN_UPDATE_COUNTS") != nullptr;
  const std::map<std::string, long> kept = read_kept_counts();
  std::string lines;
  for (const CountedKernel& kernel : counted_kernels()) {
    const long count = count_instructions(kernel);
    lines += fmt::format("{} {}\n", kernel.name(), count);
    if (keeps) continue;
    ASSERT_TRUE(kept.contains(kernel.name())) << kernel.name();
    const double ratio = static_cast<double>(count) / static_cast<double>(kept.at(kernel.name()));
    EXPECT_LE(ratio, 1 + slack) << kernel.name() << ": " << count << " instructions instead of "
                                << kept.at(kernel.name());
    if (ratio < 1 - slack) {
      fmt::print("{}: {} instructions instead of {}: keep the better count\n", kernel.name(), count,
                 kept.at(kernel.name()));
    }
  }
  if (keeps) std::ofstream(KEPT_COUNTS) << lines;
}

}  // namespace
}  // namespace elastogen::selector
