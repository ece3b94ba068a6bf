#include "selector/io/curve_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "selector/io/gnuplot.h"

namespace elastogen::selector {
namespace {

std::string data_block(const std::string& name, const DeflectionCurve& curve) {
  std::string text = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    text += fmt::format("{:.17g} {:.17g}\n", curve.x[i], curve.deflection(i));
  }
  return text + "END\n";
}

/// 1000 (deflection - reference) at the curve's sections.
DeflectionCurve millimetres_from(const DeflectionCurve& curve, const DeflectionCurve& reference) {
  DeflectionCurve difference = interpolate(reference, curve.x);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    difference.displacement[i][static_cast<std::size_t>(curve.dim - 1)] =
        1000 * (curve.deflection(i) - difference.deflection(i));
  }
  return difference;
}

}  // namespace

void draw_curve(const std::filesystem::path& picture, const DeflectionCurve& curve,
                const std::optional<NamedCurve>& reference, const std::string& title) {
  std::string script = data_block("curve", curve);
  script += fmt::format(
      "set grid lt 1 lw 1 lc rgb '#dddddd'\nset lmargin 11\nset rmargin 3\n"
      "set ylabel 'mean {} of the section [m]'\n",
      curve.deflection_name());
  // What is only rounding shall look like it.
  double largest = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    largest = std::max(largest, std::abs(curve.deflection(i)));
  }
  const double smallest_range = 1e-6 * (curve.x.back() - curve.x.front());
  if (largest < smallest_range) {
    script += fmt::format("set yrange [{}:{}]\n", -smallest_range, smallest_range);
  }
  const std::string own =
      "$curve using 1:2 with linespoints lt 1 lw 2 pt 7 ps 0.6 lc rgb '#1f5fa8' "
      "title 'this run'";
  if (!reference) {
    script += fmt::format("set title {} font ',15'\nset xlabel 'x [m]'\nplot {}\n",
                          gnuplot_quoted(title), own);
    draw_png(picture, 1000, 600, script);
    return;
  }
  script += data_block("reference", reference->curve);
  script += data_block("difference", millimetres_from(curve, reference->curve));
  script += fmt::format(
      "set multiplot layout 2,1 title {} font ',15'\n"
      "plot {}, $reference using 1:2 with points pt 6 ps 1.6 lw 1.5 lc rgb '#c04000' title {}\n"
      "set xlabel 'x [m]'\nset ylabel 'difference [mm]'\n"
      "set key off\nset xzeroaxis lc rgb '#808080'\n"
      "plot $difference using 1:2 with linespoints lt 1 lw 2 pt 7 ps 0.6 lc rgb '#1f5fa8'\n"
      "unset multiplot\n",
      gnuplot_quoted(title), own, gnuplot_quoted(reference->label));
  draw_png(picture, 1000, 900, script);
}

}  // namespace elastogen::selector
