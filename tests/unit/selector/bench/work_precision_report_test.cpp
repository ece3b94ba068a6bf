#include "selector/bench/work_precision_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "selector/bench/pareto.h"
#include "selector/bench/svg_chart.h"
#include "selector/bench/thesis_sections.h"
#include "selector/bench/thesis_tables.h"

namespace elastogen::selector {
namespace {

using Points = std::vector<WorkPrecisionPoint>;

WorkPrecisionPoint point(const std::string& element, double seconds, double error) {
  WorkPrecisionPoint result;
  result.problem = "bending";
  result.program = element.starts_with("C3D") ? "calculix" : "elastogen";
  result.law = "stvk";
  result.element = element;
  result.association = result.program == "calculix" ? "stvk " + element : "stvk-" + element;
  result.resolution = "12x2x2";
  result.solver = "cholesky";
  result.precision = "double";
  result.process_seconds = seconds;
  result.solve_seconds = result.program == "calculix" ? 0 : seconds / 2;
  result.error = error;
  return result;
}

Points failed(Points points) {
  for (WorkPrecisionPoint& p : points) p.failure = "did not converge <in time>";
  return points;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

bool contains(const std::string& text, const std::string& part) { return count(text, part) > 0; }

TEST(ParetoFront, HoldsWhatNothingBeats) {
  Points points = {point("a", 4, 1e-3), point("b", 1, 1e-1), point("c", 2, 2e-1),
                   point("d", 4, 2e-3), point("e", 8, 1e-3), point("f", 9, 1e-5)};
  points.push_back(failed({point("g", 0.1, 0)}).front());
  points.push_back(point("h", 0.1, std::numeric_limits<double>::quiet_NaN()));
  const Points front = pareto_front(points, WorkTime::process);
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].element, "b");
  EXPECT_EQ(front[1].element, "a");
  EXPECT_EQ(front[2].element, "f");
  EXPECT_TRUE(pareto_front({}, WorkTime::solve).empty());
}

TEST(ParetoFront, LeavesOutWhatHasNoSolveTime) {
  EXPECT_TRUE(pareto_front({point("C3D8", 1, 0.1)}, WorkTime::solve).empty());
  EXPECT_EQ(pareto_front({point("C3D8", 1, 0.1)}, WorkTime::process).size(), 1u);
}

TEST(FastestFor, TakesTheLeastTime) {
  const Points points = {point("a", 4, 1e-3), point("b", 1, 1e-1), point("c", 9, 1e-5)};
  EXPECT_EQ(fastest_for(points, 1e-1, WorkTime::process)->element, "b");
  EXPECT_EQ(fastest_for(points, 0.09, WorkTime::process)->element, "a");
  EXPECT_FALSE(fastest_for(points, 1e-6, WorkTime::process).has_value());
}

TEST(InterpolatedTime, IsStraightInTheLogarithms) {
  const Points points = {point("C3D8", 1, 1e-1), point("C3D8", 100, 1e-3)};
  EXPECT_NEAR(interpolated_time(points, 1e-2)->seconds, 10, 1e-12);
  EXPECT_NEAR(interpolated_time(points, 1e-3)->seconds, 100, 1e-12);
  EXPECT_EQ(interpolated_time(points, 0.5)->seconds, 1);
  EXPECT_FALSE(interpolated_time(points, 9e-4).has_value());
}

TEST(InterpolatedTime, KeepsToTheCurveOfOneElement) {
  const Points points = {point("C3D8", 1, 1e-1), point("C3D8", 100, 1e-3), point("C3D20", 30, 1e-2),
                         point("C3D20", 60, 1e-4)};
  EXPECT_EQ(interpolated_time(points, 1e-2)->element, "C3D8");
  const auto finer = interpolated_time(points, 1e-3);
  EXPECT_EQ(finer->element, "C3D20");
  EXPECT_NEAR(finer->seconds, 30 * std::sqrt(2), 1e-9);
}

TEST(Sentences, NameTheFastestAndCompareAtTheSameError) {
  const Points points = {point("hexa20", 0.031, 8e-4), point("hexa8", 0.2, 5e-3),
                         point("C3D20R", 0.1, 8e-3), point("C3D20R", 1, 8e-5)};
  const std::vector<std::string> sentences = work_precision_sentences(points);
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_EQ(sentences[0],
            "stvk, for 1 %: fastest is stvk-hexa20, 12x2x2, cholesky: 31 ms whole process "
            "(15.5 ms solve), error 0.08 %. CalculiX: C3D20R, 12x2x2: 100 ms, error 0.8 % (3.2 "
            "times as long). At our error of 0.08 % it takes 316 ms (C3D20R, between its points): "
            "10 times as long.");
  EXPECT_EQ(sentences[2],
            "stvk, for 0.01 %: reached by no measured point of elastogen; elastogen's least error "
            "is 0.08 %: stvk-hexa20, 12x2x2, 31 ms. CalculiX: C3D20R, 12x2x2: 1 s, error 0.008 %.");
}

TEST(Sentences, SayWhenNobodyReachesAnErrorAndStopThere) {
  const std::vector<std::string> sentences = work_precision_sentences({point("tet4", 2, 5e-3)});
  ASSERT_EQ(sentences.size(), 2u);
  EXPECT_TRUE(contains(sentences[1], "for 0.1 %: reached by no measured point; elastogen's least"));
  const auto slower = work_precision_sentences({point("tet4", 2, 5e-3), point("C3D8", 1, 9e-3)});
  EXPECT_TRUE(contains(slower[0], "(0.5 of the time). It does not reach our 0.5 %.")) << slower[0];
  EXPECT_TRUE(work_precision_sentences(failed({point("tet4", 2, 5e-3)})).size() == 1);
}

TEST(FigureText, HasNoExponents) {
  EXPECT_EQ(figure_text(1, TickFormat::percent), "100 %");
  EXPECT_EQ(figure_text(0.0008, TickFormat::percent), "0.08 %");
  EXPECT_EQ(figure_text(1e-7, TickFormat::percent), "0.00001 %");
  EXPECT_EQ(figure_text(0.123456, TickFormat::percent), "12 %");
  EXPECT_EQ(figure_text(0.0314, TickFormat::seconds), "31.4 ms");
  EXPECT_EQ(figure_text(1234, TickFormat::seconds), "1234 s");
}

TEST(SvgChart, LeavesOutWhatAnAxisCannotHave) {
  Chart chart;
  chart.x.logarithmic = true;
  chart.series.emplace_back().points = {
      {0, 1, "zero"}, {-1, 1, "negative"}, {std::nan(""), 1, "none"}, {2, 1, "two <&>"}};
  const std::string text = svg(chart);
  EXPECT_EQ(count(text, "<circle"), 1u);
  EXPECT_TRUE(contains(text, "<title>two &lt;&amp;&gt;</title>"));
  EXPECT_FALSE(contains(text, "nan"));
}

TEST(SvgChart, DrawsWithoutPoints) {
  Chart chart;
  EXPECT_FALSE(contains(svg(chart), "nan"));
  chart.x.logarithmic = chart.y.logarithmic = true;
  EXPECT_FALSE(contains(svg(chart), "nan"));
}

class Report : public testing::Test {
 protected:
  static std::string page(const Points& points) {
    return work_precision_html(points, {{"bending", "Beam in bending", "8 m", "mean u_z"}},
                               {"2024-05-17T09:30:00Z", "a <fast> processor", 2, "g++", "0.1"},
                               {"<h2>More</h2>"});
  }
};

TEST_F(Report, ShowsEveryPointInItsCharts) {
  Points points = {point("hexa20", 0.031, 8e-4), point("hexa8", 0.2, 5e-3),
                   point("C3D20R", 0.1, 8e-3)};
  points.push_back(failed({point("tet4", 1, 0)}).front());
  const std::string text = page(points);
  EXPECT_EQ(count(text, "<svg"), 2u);
  EXPECT_EQ(count(text, "<title>stvk-hexa20"), 2u);
  EXPECT_EQ(count(text, "<title>stvk-hexa8"), 2u);
  EXPECT_EQ(count(text, "<title>stvk C3D20R (CalculiX)"), 1u);  // its solve is not known
  EXPECT_TRUE(contains(text, "did not converge &lt;in time&gt;"));
  EXPECT_TRUE(contains(text, "a &lt;fast&gt; processor"));
  EXPECT_TRUE(contains(text, "<h2>More</h2>"));
  for (const char* outside : {"http://", "https://", "src=", "<script", "url("}) {
    EXPECT_EQ(count(text, outside), count(text, std::string(outside) + "www.w3.org")) << outside;
  }
}

TEST_F(Report, IsAPageWhateverIsMissing) {
  EXPECT_FALSE(contains(page({}), "Beam in bending"));
  const std::string text = page(failed({point("tet4", 1, 0)}));
  EXPECT_TRUE(contains(text, "1 point has no figure"));
  EXPECT_FALSE(contains(text, "<svg"));
}

TEST(Thesis, AnalyticDeflection) {
  EXPECT_EQ(thesis_deflection(0), 0);
  EXPECT_NEAR(thesis_deflection(8), -0.60273, 5e-6);
  // E I u'''' = -rho g A by a fourth difference
  const double h = 0.5;
  const double fourth =
      (thesis_deflection(4 - 2 * h) - 4 * thesis_deflection(4 - h) + 6 * thesis_deflection(4) -
       4 * thesis_deflection(4 + h) + thesis_deflection(4 + 2 * h)) /
      std::pow(h, 4);
  EXPECT_NEAR(fourth * 100e6 / 12, -9810, 1e-3);
}

TEST(Thesis, DistanceIsTheMeanOverSections) {
  ThesisCurve curve;
  for (const double x : {0., 4., 8.}) {
    curve.x.push_back(x);
    curve.uz.push_back(thesis_deflection(x) + (x == 4 ? 0.003 : x == 8 ? -0.006 : 0));
  }
  EXPECT_NEAR(mean_distance_to_line(curve), 0.003, 1e-15);
}

TEST(Thesis, SectionsHaveBothSidesFigures) {
  const std::string table = thesis_table_6_6_html({{"hexa8", 3072, 1.5e-3, 4e-3, 0.1}}, 3.94e-3);
  EXPECT_TRUE(contains(table, "<td>0.791</td>"));  // thesis, hexahedra, 3072
  EXPECT_TRUE(contains(table, "<td>1.5</td><td>4</td>"));
  EXPECT_TRUE(contains(table, "3.94 mm"));
  const std::string torsion = thesis_table_6_7_html({{"hexa8", "C3D20", 1e-3, 2e-3, 0}});
  EXPECT_TRUE(contains(torsion, "<td>37</td>"));  // 0.0369966 m
  EXPECT_TRUE(contains(torsion, "<td>1</td><td>2</td><td>0</td>"));
  ThesisCurve curve{"prism6", 6000, {0, 4, 8}, {0, -0.2, -0.6}};
  const std::string curves = thesis_curves_html({curve}, curve);
  EXPECT_EQ(count(curves, "<svg"), 2u);
  EXPECT_TRUE(contains(curves, "figure 6.14: prisms"));
  EXPECT_EQ(count(thesis_figure_6_16_html({{"tet4", 3072, 1e-2, 2e-2, 0.1}}), "<svg"), 2u);
}

}  // namespace
}  // namespace elastogen::selector
