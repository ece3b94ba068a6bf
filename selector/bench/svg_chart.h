// Charts as SVG for HTML pages.
//
// Not by gnuplot, which draws the command line's other pictures: in its SVG a point tells its
// figures only through 34 kB of script per picture, whose names collide as soon as one page holds
// two pictures. Here a point has a <title>, which every browser shows without a script.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace elastogen::selector {

enum class Marker { circle, square, triangle, diamond, inverted_triangle, none };

/// How numbers stand at an axis.
enum class TickFormat { number, seconds, percent };

struct ChartAxis {
  std::string label;  ///< with its unit
  bool logarithmic = false;
  TickFormat format = TickFormat::number;
  std::optional<double> low, high;  ///< otherwise as the points need; points outside are drawn at
                                    ///< the edge
};

struct ChartPoint {
  double x = 0;
  double y = 0;
  std::string hover;  ///< shown under the mouse; lines are separated by '\n'
};

/// Points of one look.
struct ChartSeries {
  std::string name;  ///< in the legend; empty: not there
  std::string colour = "#000000";
  Marker marker = Marker::circle;
  bool filled = true;
  double size = 5;     ///< of markers: half their width [px]
  double opacity = 1;  ///< of markers
  double line = 0;     ///< width of the line through the points in their order [px]; 0: none
  bool dashed = false;
  double line_opacity = 1;
  std::vector<ChartPoint> points;
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series;  ///< later ones lie on top; one without points is in the legend
  int width = 900;                  ///< [px] at which letters have the size of the page's text
  int height = 500;
  int legend_width = 150;  ///< at the right; 0: no legend
};

/// One <svg> element that grows and shrinks with the page. Points that a logarithmic axis cannot
/// have (zero, negative, not a number) are left out.
[[nodiscard]] std::string svg(const Chart& chart);

/// Text with what HTML and SVG would take for markup replaced.
[[nodiscard]] std::string html_text(const std::string& text);

/// "0.08 %", "31 ms", "0.00123": as at an axis; two significant digits of a percentage, three of
/// the others.
[[nodiscard]] std::string figure_text(double value, TickFormat format);

}  // namespace elastogen::selector
