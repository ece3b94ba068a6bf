#include "selector/bench/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace elastogen::selector {
namespace {

constexpr double margin_left = 78, margin_right = 18, margin_top = 34, margin_bottom = 52;

struct Tick {
  double value = 0;
  bool labelled = false;
};

/// One axis in pixels.
class Scale {
 public:
  Scale(const ChartAxis& axis, double low, double high, double from, double to)
      : axis_(axis), low_(low), high_(high), from_(from), to_(to) {}

  [[nodiscard]] double pixel(double value) const {
    const double share = axis_.logarithmic ? std::log(value / low_) / std::log(high_ / low_)
                                           : (value - low_) / (high_ - low_);
    return from_ + std::clamp(share, 0.0, 1.0) * (to_ - from_);
  }
  [[nodiscard]] std::vector<Tick> ticks() const {
    return axis_.logarithmic ? logarithmic_ticks() : linear_ticks();
  }
  [[nodiscard]] bool has(double value) const {
    return std::isfinite(value) && (!axis_.logarithmic || value > 0);
  }

 private:
  [[nodiscard]] bool inside(double value) const {
    const double slack = 1e-9 * std::abs(high_ - low_);
    return axis_.logarithmic ? value > low_ * (1 - 1e-9) && value < high_ * (1 + 1e-9)
                             : value > low_ - slack && value < high_ + slack;
  }
  [[nodiscard]] std::vector<Tick> logarithmic_ticks() const {
    const double decades = std::log10(high_ / low_);
    std::vector<Tick> ticks;
    for (int k = static_cast<int>(std::floor(std::log10(low_))); std::pow(10., k) <= high_; ++k) {
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = digit * std::pow(10., k);
        const bool labelled = digit == 1 || (decades < 2.2 && (digit == 2 || digit == 5));
        if (inside(value)) ticks.push_back({value, labelled});
      }
    }
    return ticks;
  }
  [[nodiscard]] std::vector<Tick> linear_ticks() const {
    const double rough = (high_ - low_) / 6;
    const double decade = std::pow(10., std::floor(std::log10(rough)));
    double step = 10 * decade;
    for (const double factor : {5., 2., 1.}) {
      if (rough <= factor * decade) step = factor * decade;
    }
    std::vector<Tick> ticks;
    for (double k = std::ceil(low_ / step - 1e-9); inside(k * step); ++k)
      ticks.push_back({k * step + 0.0, true});  // no -0
    return ticks;
  }

  const ChartAxis& axis_;
  double low_, high_, from_, to_;
};

/// The range of the points, widened a little, or what the axis asks for.
std::pair<double, double> range_of(const Chart& chart, const ChartAxis& axis,
                                   double ChartPoint::*coordinate) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      const double value = point.*coordinate;
      if (!std::isfinite(value) || (axis.logarithmic && value <= 0)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(low <= high)) low = high = 1;
  if (axis.logarithmic) {
    // A tenth of the range, and at least a decade in all.
    const double margin = std::max(0.06 * std::log10(high / low), (1 - std::log10(high / low)) / 2);
    low /= std::pow(10., std::max(margin, 0.08));
    high *= std::pow(10., std::max(margin, 0.08));
  } else {
    const double margin = high > low ? 0.03 * (high - low) : std::max(std::abs(low), 1.) * 0.1;
    low -= margin;
    high += margin;
  }
  return {axis.low.value_or(low), axis.high.value_or(high)};
}

std::string marker(const ChartSeries& series, double x, double y, const std::string& hover) {
  const double r = series.size;
  const std::string style =
      series.filled
          ? fmt::format("fill=\"{0}\" stroke=\"#fff\" stroke-width=\"0.8\"", series.colour)
          : fmt::format("fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.8\"", series.colour);
  const std::string opacity =
      series.opacity < 1 ? fmt::format(" opacity=\"{:g}\"", series.opacity) : "";
  const std::string title = hover.empty() ? "" : fmt::format("<title>{}</title>", html_text(hover));
  const auto polygon = [&](std::initializer_list<std::pair<double, double>> corners) {
    std::string points;
    for (const auto& [dx, dy] : corners)
      points += fmt::format("{:.1f},{:.1f} ", x + dx * r, y + dy * r);
    points.pop_back();
    return fmt::format("<polygon class=\"mark\" points=\"{}\" {}{}>{}</polygon>\n", points, style,
                       opacity, title);
  };
  switch (series.marker) {
    case Marker::circle:
      return fmt::format(
          "<circle class=\"mark\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" {}{}>{}</circle>\n", x, y,
          r, style, opacity, title);
    case Marker::square:
      return polygon({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
    case Marker::triangle:
      return polygon({{0, -1.25}, {1.15, 0.8}, {-1.15, 0.8}});
    case Marker::inverted_triangle:
      return polygon({{0, 1.25}, {1.15, -0.8}, {-1.15, -0.8}});
    case Marker::diamond:
      return polygon({{0, -1.35}, {1.35, 0}, {0, 1.35}, {-1.35, 0}});
    case Marker::none:
      break;
  }
  return {};
}

std::string line_style(const ChartSeries& series) {
  return fmt::format(
      "fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" stroke-linejoin=\"round\"{}{}",
      series.colour, series.line, series.dashed ? " stroke-dasharray=\"6 4\"" : "",
      series.line_opacity < 1 ? fmt::format(" opacity=\"{:g}\"", series.line_opacity) : "");
}

std::string polyline(const ChartSeries& series, const Scale& x, const Scale& y) {
  std::string path;
  for (const ChartPoint& point : series.points) {
    if (!x.has(point.x) || !y.has(point.y)) continue;
    const double px = x.pixel(point.x), py = y.pixel(point.y);
    if (path.empty()) {
      path = fmt::format("M{:.1f} {:.1f}", px, py);
    } else {
      path += fmt::format("L{:.1f} {:.1f}", px, py);
    }
  }
  return path.empty() ? "" : fmt::format("<path d=\"{}\" {}/>\n", path, line_style(series));
}

std::string legend(const Chart& chart, double left) {
  std::string text;
  double y = margin_top + 8;
  for (const ChartSeries& series : chart.series) {
    if (series.name.empty()) continue;
    if (series.line > 0) {
      text += fmt::format("<path d=\"M{:.1f} {:.1f}h24\" {}/>\n", left, y, line_style(series));
    }
    text += marker(series, left + 12, y, "");
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + 32, y + 4.5,
                        html_text(series.name));
    y += 21;
  }
  return text;
}

/// Two significant digits and no exponent: 100, 0.08, 0.000098.
std::string percent_text(double percent) {
  if (percent == 0) return "0 %";
  const double digits = std::floor(std::log10(std::abs(percent)) + 1e-9);
  std::string text =
      fmt::format("{:.{}f}", percent, static_cast<int>(std::clamp(1 - digits, 0., 12.)));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text + " %";
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string figure_text(double value, TickFormat format) {
  if (!std::isfinite(value)) return "–";
  switch (format) {
    case TickFormat::percent:
      return percent_text(100 * value);
    case TickFormat::seconds:
      if (std::abs(value) < 1e-3) return fmt::format("{:.3g} µs", 1e6 * value);
      if (std::abs(value) < 1) return fmt::format("{:.3g} ms", 1e3 * value);
      return value < 1000 ? fmt::format("{:.3g} s", value) : fmt::format("{:.0f} s", value);
    case TickFormat::number:
      break;
  }
  return fmt::format("{:.3g}", value);
}

std::string svg(const Chart& chart) {
  const double left = margin_left;
  const double right = chart.width - margin_right - chart.legend_width;
  const double top = margin_top, bottom = chart.height - margin_bottom;
  const auto [x_low, x_high] = range_of(chart, chart.x, &ChartPoint::x);
  const auto [y_low, y_high] = range_of(chart, chart.y, &ChartPoint::y);
  const Scale x(chart.x, x_low, x_high, left, right);
  const Scale y(chart.y, y_low, y_high, bottom, top);

  std::string text = fmt::format(
      "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
      "style=\"max-width:{0}px\" font-family=\"system-ui,'DejaVu Sans',sans-serif\" "
      "font-size=\"13\" fill=\"#333\" role=\"img\" aria-label=\"{2}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n"
      "<text x=\"{3}\" y=\"20\" font-size=\"15\" font-weight=\"600\" fill=\"#111\">{2}</text>\n",
      chart.width, chart.height, html_text(chart.title), left);
  const auto grid_colour = [](const Tick& tick) { return tick.labelled ? "#dcdfe4" : "#f0f1f4"; };
  for (const Tick& tick : x.ticks()) {
    const double at = x.pixel(tick.value);
    text += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"{}\"/>\n", at, top, bottom,
                        grid_colour(tick));
    if (!tick.labelled) continue;
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", at,
                        bottom + 18, figure_text(tick.value, chart.x.format));
  }
  for (const Tick& tick : y.ticks()) {
    const double at = y.pixel(tick.value);
    text += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"{}\"/>\n", left, at, right,
                        grid_colour(tick));
    if (!tick.labelled) continue;
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", left - 8,
                        at + 4.5, figure_text(tick.value, chart.y.format));
  }
  text += fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" fill=\"none\" stroke=\"#8a9099\"/>\n"
      "<text x=\"{4:.1f}\" y=\"{5}\" text-anchor=\"middle\">{6}</text>\n"
      "<text transform=\"translate(18 {7:.1f}) rotate(-90)\" text-anchor=\"middle\">{8}</text>\n",
      left, top, bottom, right, (left + right) / 2, chart.height - 12, html_text(chart.x.label),
      (top + bottom) / 2, html_text(chart.y.label));

  for (const ChartSeries& series : chart.series) {
    if (series.line > 0) text += polyline(series, x, y);
  }
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (!x.has(point.x) || !y.has(point.y)) continue;
      text += marker(series, x.pixel(point.x), y.pixel(point.y), point.hover);
    }
  }
  if (chart.legend_width > 0) text += legend(chart, right + 18);
  return text + "</svg>\n";
}

}  // namespace elastogen::selector
