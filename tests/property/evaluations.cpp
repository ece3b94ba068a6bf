#include "evaluations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "runtime/kernel_abi.h"

namespace elastogen::test {
namespace {

double largest(const std::vector<std::string>& texts) {
  double result = 0;
  for (const std::string& text : texts) result = std::max(result, std::abs(std::stod(text)));
  return result;
}

void expect_near(const std::vector<std::string>& found, const std::vector<std::string>& expected,
                 double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    ASSERT_NEAR(std::stod(found[k]), std::stod(expected[k]), tolerance);
  }
}

/// Numbers first ... first + count - 1 of each point.
std::vector<std::string> part_of(const std::vector<std::string>& stress, int first, int count) {
  std::vector<std::string> part;
  for (auto point = stress.begin(); point != stress.end(); point += stress_numbers) {
    part.insert(part.end(), point + first, point + first + count);
  }
  return part;
}

}  // namespace

void expect_agrees(const symgen::Evaluation& found, const symgen::Evaluation& exact,
                   double rounding) {
  ASSERT_EQ(found.status, "ok");
  EXPECT_NEAR(std::stod(found.energy), std::stod(exact.energy), rounding * std::stod(exact.energy));
  expect_near(found.forces, exact.forces, rounding * largest(exact.forces));
  expect_near(found.product, exact.product, rounding * largest(exact.stiffness));
  expect_near(found.stiffness, exact.stiffness, rounding * largest(exact.stiffness));
  for (const auto& [first, count] :
       {std::pair{0, 9}, std::pair{9, 9}, std::pair{18, 1}, std::pair{19, 1}}) {
    const std::vector<std::string> expected = part_of(exact.stress, first, count);
    expect_near(part_of(found.stress, first, count), expected, rounding * largest(expected));
  }
}

}  // namespace elastogen::test
