#include "selector/io/deflection_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scene/temporary_scene.h"

namespace elastogen::selector {
namespace {

DeflectionCurve sampled(const std::vector<double>& x, double (*uz)(double)) {
  DeflectionCurve curve;
  for (const double at : x) {
    curve.x.push_back(at);
    curve.displacement.push_back({0.5 * at, 0, uz(at)});
  }
  return curve;
}

double cubic(double x) { return ((0.3 * x - 1.2) * x + 0.4) * x - 0.1; }

TEST(DeflectionCurve, SplineReproducesCubics) {
  const DeflectionCurve curve = sampled({0, 0.7, 1.5, 2, 3.1, 4}, cubic);
  const std::vector<double> between = {0, 0.1, 0.7, 1.2, 2.9, 3.7, 4};
  const DeflectionCurve result = interpolate(curve, between);
  for (std::size_t i = 0; i < between.size(); ++i) {
    EXPECT_NEAR(result.displacement[i][2], cubic(between[i]), 1e-13);
    EXPECT_NEAR(result.displacement[i][0], 0.5 * between[i], 1e-13);
  }
}

TEST(DeflectionCurve, FewSectionsGiveALineOrAParabola) {
  const std::vector<double> at = {0.25};
  const DeflectionCurve line = sampled({0, 1}, [](double x) { return 2 * x - 1; });
  EXPECT_NEAR(interpolate(line, at).displacement[0][2], -0.5, 1e-15);
  const DeflectionCurve parabola = sampled({0, 0.4, 1}, [](double x) { return x * x; });
  EXPECT_NEAR(interpolate(parabola, at).displacement[0][2], 0.0625, 1e-15);
}

TEST(DeflectionCurve, FileKeepsEveryDigit) {
  const TemporaryFolder folder;
  const DeflectionCurve curve =
      sampled({0, 1.0 / 3, std::sqrt(2)}, [](double x) { return -std::exp(x) / 7; });
  write_curve_csv(folder.path() / "curve.csv", curve, "a comment");
  const DeflectionCurve read = read_curve_csv(folder.path() / "curve.csv");
  EXPECT_EQ(read.x, curve.x);
  EXPECT_EQ(read.displacement, curve.displacement);
}

TEST(DeflectionCurve, ReadsTheReference) {
  const DeflectionCurve curve = read_curve_csv(ELASTOGEN_TEST_DATA "/cantilever.csv");
  EXPECT_EQ(curve.size(), 17U);
  EXPECT_EQ(curve.x.back(), 8);
  EXPECT_EQ(curve.displacement.back()[2], -6.075997e-01);
}

TEST(DeflectionCurve, DistanceIsTheMeanOverSections) {
  const DeflectionCurve reference = sampled({0, 1, 2, 3, 4}, cubic);
  DeflectionCurve curve = sampled({0, 2, 4}, cubic);
  curve.displacement[1][2] += 0.03;
  curve.displacement[2][2] -= 0.06;
  const CurveDistance result = distance(curve, reference);
  EXPECT_NEAR(result.mean, 0.03, 1e-13);
  EXPECT_NEAR(result.tip, -0.06, 1e-13);
}

TEST(DeflectionCurve, MeansAreOverTheNodesOfASection) {
  const std::vector<double> x = {0, 1};
  const std::vector<std::vector<std::int32_t>> sections = {{0, 2}, {1}};
  const std::vector<double> displacement = {1, 2, 3, 4, 5, 6, 7, 8, 10};
  const DeflectionCurve curve = mean_of_sections(x, sections, displacement, 3);
  EXPECT_EQ(curve.displacement[0], (std::array<double, 3>{4, 5, 6.5}));
  EXPECT_EQ(curve.displacement[1], (std::array<double, 3>{4, 5, 6}));
}

void expect_rejected(const std::string& text, const std::string& piece) {
  const TemporaryFolder folder;
  try {
    (void)read_curve_csv(write_file(folder, "curve.csv", text));
    FAIL() << text;
  } catch (const InputError& error) {
    expect_contains(error.what(), piece);
  }
}

TEST(DeflectionCurve, RejectsWrongFiles) {
  expect_rejected("x,ux,uz\n", "curve.csv:1: 'x,ux,uz': the header must be");
  expect_rejected("# c\nx,ux,uy,uz\n0,0,0,0\n1,0,0\n", "curve.csv:4: '1,0,0': must be four");
  expect_rejected("x,ux,uy,uz\n0,0,0,0\n1,0,0,nan\n", "curve.csv:3");
  expect_rejected("x,ux,uy,uz\n1,0,0,0\n1,0,0,0\n", "curve.csv:3: x = 1: must be greater than 1");
  expect_rejected("x,ux,uy,uz\n1,0,0,0\n", "1 sections: a curve needs two");
}

TEST(DeflectionCurve, RejectsPositionsOutside) {
  const std::vector<double> outside = {4.1};
  EXPECT_THROW((void)interpolate(sampled({0, 1, 4}, cubic), outside), InputError);
}

}  // namespace
}  // namespace elastogen::selector
