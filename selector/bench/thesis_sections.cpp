#include "selector/bench/thesis_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "selector/bench/element_look.h"
#include "selector/bench/svg_chart.h"
#include "selector/bench/thesis_tables.h"

namespace elastogen::selector {
namespace {

struct ThesisElement {
  const char* element;
  const char* plural;
  const char* figure;  ///< with its deflection curves
};

constexpr ThesisElement thesis_elements[] = {{"hexa8", "hexahedra", "6.12"},
                                             {"tet4", "tetrahedra", "6.13"},
                                             {"prism6", "prisms", "6.14"},
                                             {"pyramid5", "pyramids", "6.15"}};

std::string millimetres(double metres) {
  return std::isfinite(metres) ? fmt::format("{:.3g}", 1e3 * metres) : std::string("–");
}

/// Colours of resolutions, from coarse to fine.
std::string resolution_colour(std::size_t index, std::size_t count) {
  const double share =
      count > 1 ? static_cast<double>(index) / static_cast<double>(count - 1) : 1.0;
  const auto channel = [&](int coarse, int fine) {
    return static_cast<int>(std::lround(coarse + share * (fine - coarse)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0xa9, 0x12), channel(0xcb, 0x3f),
                     channel(0xea, 0x7d));
}

ChartSeries line_of(const ThesisCurve& curve, std::string name, std::string colour, double width) {
  ChartSeries series;
  series.name = std::move(name);
  series.colour = std::move(colour);
  series.marker = Marker::none;
  series.line = width;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    series.points.push_back({curve.x[i], curve.uz[i], ""});
  return series;
}

ThesisCurve analytic_line() {
  ThesisCurve line;
  for (int i = 0; i <= 160; ++i) {
    line.x.push_back(i / 20.0);
    line.uz.push_back(thesis_deflection(line.x.back()));
  }
  return line;
}

/// The last part of a curve, from `first` on.
ThesisCurve end_of(const ThesisCurve& curve, double first) {
  ThesisCurve end;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    // Between sections too, so that the line enters the picture at its edge.
    if (curve.x[i] < first) {
      if (i + 1 >= curve.x.size() || curve.x[i + 1] <= first) continue;
      const double share = (first - curve.x[i]) / (curve.x[i + 1] - curve.x[i]);
      end.x.push_back(first);
      end.uz.push_back(curve.uz[i] + share * (curve.uz[i + 1] - curve.uz[i]));
    } else {
      end.x.push_back(curve.x[i]);
      end.uz.push_back(curve.uz[i]);
    }
  }
  return end;
}

/// One of the two pictures of an element.
std::string deflection_chart(const std::vector<const ThesisCurve*>& curves,
                             const ThesisCurve& converged, const std::string& title,
                             double first_x) {
  Chart chart;
  chart.title = title;
  const bool zoomed = first_x > 0;
  chart.width = zoomed ? 680 : 520;
  chart.x.label = "x at rest [m]";
  chart.y.label = "u_z [m]";
  chart.height = 380;
  chart.legend_width = zoomed ? 160 : 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    chart.series.push_back(line_of(end_of(*curves[i], first_x),
                                   fmt::format("{} elements", curves[i]->num_elements),
                                   resolution_colour(i, curves.size()), 2));
    if (!zoomed) continue;
    ChartSeries sections = line_of(*curves[i], "", chart.series.back().colour, 0);
    sections.marker = Marker::circle;
    sections.size = 3;
    std::erase_if(sections.points, [&](const ChartPoint& point) { return point.x < first_x; });
    for (ChartPoint& point : sections.points) {
      point.hover = fmt::format("{} elements\nx = {:.4g} m\nu_z = {:.5f} m",
                                curves[i]->num_elements, point.x, point.y);
    }
    chart.series.push_back(std::move(sections));
  }
  chart.series.push_back(line_of(end_of(converged, first_x), "converged, 3D", "#111111", 1.6));
  chart.series.push_back(
      line_of(end_of(analytic_line(), first_x), "Euler–Bernoulli", "#d0312d", 1.6));
  chart.series.back().dashed = true;
  return svg(chart);
}

std::string distance_chart(const std::vector<ThesisFigure>& figures, const std::string& title,
                           double ThesisFigure::*distance) {
  std::map<std::string, std::vector<ThesisFigure>> by_element;
  for (const ThesisFigure& figure : figures) by_element[figure.element].push_back(figure);
  Chart chart;
  chart.title = title;
  chart.x = {"time [s], logarithmic", true, TickFormat::seconds, {}, {}};
  chart.y = {"mean distance [m], logarithmic", true, TickFormat::number, {}, {}};
  chart.height = 420;
  for (auto& [element, its_figures] : by_element) {
    std::sort(its_figures.begin(), its_figures.end(),
              [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
    ChartSeries series;
    series.name = element;
    series.colour = element_colour(element);
    series.line = 2;
    for (const ThesisFigure& figure : its_figures) {
      series.points.push_back(
          {figure.seconds, figure.*distance,
           fmt::format("{}, {} elements\n{}\nmean distance {} mm", element, figure.num_elements,
                       figure_text(figure.seconds, TickFormat::seconds),
                       millimetres(figure.*distance))});
    }
    chart.series.push_back(std::move(series));
  }
  return svg(chart);
}

}  // namespace

double mean_distance_to_line(const ThesisCurve& curve) {
  double sum = 0;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    sum += std::abs(curve.uz[i] - thesis_deflection(curve.x[i]));
  return sum / static_cast<double>(curve.x.size());
}

std::string thesis_table_6_6_html(const std::vector<ThesisFigure>& figures,
                                  double converged_to_line) {
  std::string text =
      "<h3>Table 6.6: mean distance of the deflection curve to the analytic one [mm]</h3>\n"
      "<div class=wide><table><thead><tr><th rowspan=2>program</th><th rowspan=2>elements</th>";
  for (const ThesisElement& element : thesis_elements)
    text += fmt::format("<th colspan=2 class=group>{}</th>", element.plural);
  text += "</tr><tr>";
  for (std::size_t i = 0; i < std::size(thesis_elements); ++i)
    text += "<th>to line</th><th>to 3D</th>";
  text += "</tr></thead>\n<tbody>";
  for (const ThesisDistances& row : thesis_table_6_6()) {
    text += fmt::format("<tr><td>thesis, {}</td><td>{}</td>", row.program, row.num_elements);
    for (const ThesisElement& element : thesis_elements)
      text += fmt::format("<td>{}</td><td>–</td>", millimetres(row.of(element.element)));
    text += "</tr>\n";
  }
  std::map<std::size_t, std::map<std::string, ThesisFigure>> rows;
  for (const ThesisFigure& figure : figures) rows[figure.num_elements][figure.element] = figure;
  for (const auto& [num_elements, by_element] : rows) {
    text += fmt::format("<tr class=ours><td>elastogen</td><td>{}</td>", num_elements);
    for (const ThesisElement& element : thesis_elements) {
      const auto found = by_element.find(element.element);
      text += found == by_element.end()
                  ? "<td>–</td><td>–</td>"
                  : fmt::format("<td>{}</td><td>{}</td>", millimetres(found->second.mean_to_line),
                                millimetres(found->second.mean_to_converged));
    }
    text += "</tr>\n";
  }
  return text +
         fmt::format(
             "</tbody></table></div>\n<p>The mean over the beam's sections of |u_z − analytic u_z| "
             "at "
             "the section's x at rest. The analytic line (Euler and Bernoulli, thesis equation "
             "5.3) leaves out shear and large displacements: the converged beam in three "
             "dimensions is itself {} mm from it, so a smaller distance to the line is not a "
             "smaller error. The distance to the converged beam (3D) is.</p>\n",
             millimetres(converged_to_line));
}

std::string thesis_curves_html(const std::vector<ThesisCurve>& curves,
                               const ThesisCurve& converged) {
  std::string text = "<h3>Figures 6.12 to 6.15: deflection by element and resolution</h3>\n";
  for (const ThesisElement& element : thesis_elements) {
    std::vector<const ThesisCurve*> its_curves;
    for (const ThesisCurve& curve : curves) {
      if (curve.element == element.element) its_curves.push_back(&curve);
    }
    if (its_curves.empty()) continue;
    std::sort(its_curves.begin(), its_curves.end(),
              [](const auto* a, const auto* b) { return a->num_elements < b->num_elements; });
    const std::string title = fmt::format("As figure {}: {}", element.figure, element.plural);
    text += "<div class=pair>\n" + deflection_chart(its_curves, converged, title, 0) +
            deflection_chart(its_curves, converged, "Its end", 7.6) + "</div>\n";
  }
  return text;
}

std::string thesis_figure_6_16_html(const std::vector<ThesisFigure>& figures) {
  return "<h3>Figure 6.16: precision against time</h3>\n"
         "<p>The thesis draws tetrahedra and hexahedra: for the same precision, tetrahedra take "
         "longer.</p>\n" +
         distance_chart(figures, "Distance to the converged beam in three dimensions",
                        &ThesisFigure::mean_to_converged) +
         distance_chart(figures, "Distance to the line of Euler and Bernoulli, as in the thesis",
                        &ThesisFigure::mean_to_line);
}

std::string thesis_table_6_7_html(const std::vector<TorsionFigure>& figures) {
  std::string text =
      "<h3>Table 6.7: torsion by half a turn, distance of nodes [mm]</h3>\n"
      "<table><thead><tr><th>mesh</th><th>against</th><th>mean</th><th>maximum</th>"
      "<th>minimum</th></tr></thead>\n<tbody>";
  for (const ThesisTorsion& row : thesis_table_6_7()) {
    text += fmt::format(
        "<tr><td>thesis, {}</td><td>Abaqus</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        row.method, millimetres(row.mean), millimetres(row.maximum), millimetres(row.minimum));
  }
  for (const TorsionFigure& figure : figures) {
    text += fmt::format(
        "<tr class=ours><td>elastogen, {}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        html_text(figure.mesh), html_text(figure.reference), millimetres(figure.mean),
        millimetres(figure.maximum), millimetres(figure.minimum));
  }
  return text + "</tbody></table>\n";
}

}  // namespace elastogen::selector
