// Kernels compiled for different instruction sets compute the same, to rounding.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "built_sets.h"
#include "selector/support/process.h"

namespace elastogen::test {
namespace {

struct Results {
  std::string instruction_set;
  int lanes = 0;
  std::vector<double> values;  ///< energy, forces, product
};

/// What print_results prints, by association and precision.
/// @param wanted  instruction set in the environment
std::map<std::string, Results> results_with(const std::string& wanted) {
  const selector::ProcessResult run = selector::run_process(
      {PRINT_RESULTS}, {.folder = {}, .environment = {{instruction_set_variable, wanted}}});
  EXPECT_EQ(run.exit_status, 0) << run.output;
  std::istringstream stream(run.output);
  std::map<std::string, Results> all;
  std::string association, precision;
  for (Results results; stream >> association >> precision >> results.instruction_set;) {
    std::size_t count = 0;
    stream >> results.lanes >> count;
    results.values.resize(count);
    for (double& value : results.values) stream >> value;
    all[association + " " + precision] = results;
  }
  EXPECT_EQ(all.size(), 8U) << run.output;
  return all;
}

double largest(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double result = 0;
  for (std::size_t k = begin; k < end; ++k) result = std::max(result, std::abs(values[k]));
  return result;
}

/// Largest difference of energy, forces and product, each relative to its largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> apart(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) apart[k] = a[k] - b[k];
  const std::size_t num_dofs = (a.size() - 1) / 2;
  double result = 0;
  for (const auto& [begin, end] :
       {std::pair<std::size_t, std::size_t>{0, 1}, {1, 1 + num_dofs}, {1 + num_dofs, a.size()}}) {
    result = std::max(result, largest(apart, begin, end) / largest(a, begin, end));
  }
  return result;
}

TEST(InstructionSets, AgreeToRounding) {
  const std::vector<std::string> sets = supported_sets();
  const auto reference = results_with(sets.front());
  for (const std::string& set : sets) {
    for (const auto& [name, results] : results_with(set)) {
      const auto& expected = reference.at(name).values;
      ASSERT_EQ(results.values.size(), expected.size());
      const bool is_single = name.ends_with("single");
      const double apart = difference(expected, results.values);
      EXPECT_LE(apart, is_single ? 1e-6 : 4e-15) << name << ", " << set << " and " << sets.front();
      RecordProperty(set + " " + name, fmt::format("{:.1e}", apart));
    }
  }
}

TEST(InstructionSets, FillTheirVectors) {
  const std::map<std::string, int> lanes = {{"x86_64", 2}, {"avx2", 4}, {"avx512", 8}};
  for (const std::string& set : supported_sets()) {
    for (const auto& [name, results] : results_with(set)) {
      EXPECT_EQ(results.instruction_set, set) << name;
      if (!lanes.contains(set)) continue;
      EXPECT_EQ(results.lanes, lanes.at(set) * (name.ends_with("single") ? 2 : 1)) << name;
    }
  }
}

TEST(InstructionSets, TheBestIsTakenUnasked) {
  for (const auto& [name, results] : results_with("")) {
    EXPECT_EQ(results.instruction_set, supported_sets().back()) << name;
  }
}

TEST(InstructionSets, AProgramEndsWhereTheEnvironmentIsWrong) {
  if (!is_chosen()) GTEST_SKIP() << "native alone: there is nothing to choose";
  for (const char* wanted : {"sse9", "avx512"}) {
    if (processor_supports(wanted)) continue;
    const selector::ProcessResult run = selector::run_process(
        {PRINT_RESULTS}, {.folder = {}, .environment = {{instruction_set_variable, wanted}}});
    EXPECT_EQ(run.exit_status, 2) << run.output;
    const std::string begin =
        std::string("error: ELASTOGEN_INSTRUCTION_SET = '") + wanted + "' in the environment: ";
    EXPECT_TRUE(run.output.starts_with(begin)) << run.output;
  }
}

}  // namespace
}  // namespace elastogen::test
