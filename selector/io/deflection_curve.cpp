#include "selector/io/deflection_curve.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "runtime/error.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

const char* curve_header(int dim) { return dim == 2 ? "x,ux,uy" : "x,ux,uy,uz"; }

/// x and `dim` components, separated by commas; the other components are 0.
std::array<double, 4> parse_row(const std::string& line, int dim, const std::string& where) {
  std::array<double, 4> row{};
  const auto count = static_cast<std::size_t>(dim + 1);
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [next, error] = std::from_chars(at, end, row[i]);
    const bool separated = i + 1 < count ? next < end && *next == ',' : next == end;
    if (error != std::errc() || !separated || !std::isfinite(row[i])) {
      throw InputError(fmt::format("{}: '{}': must be {} finite numbers separated by commas ({})",
                                   where, line, dim == 2 ? "three" : "four", curve_header(dim)));
    }
    at = next + 1;
  }
  return row;
}

/// Second derivatives at the knots of the not-a-knot cubic spline, one column per component.
/// Dense: curves have some dozens of sections.
Eigen::MatrixXd spline_curvatures(const DeflectionCurve& curve) {
  const auto n = static_cast<Eigen::Index>(curve.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
  if (n < 3) return right;
  const auto width = [&](Eigen::Index i) {
    return curve.x[static_cast<std::size_t>(i) + 1] - curve.x[static_cast<std::size_t>(i)];
  };
  const auto value = [&](Eigen::Index i, int c) {
    return curve.displacement[static_cast<std::size_t>(i)][static_cast<std::size_t>(c)];
  };
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    system(i, i - 1) = width(i - 1);
    system(i, i) = 2 * (width(i - 1) + width(i));
    system(i, i + 1) = width(i);
    for (int c = 0; c < 3; ++c) {
      right(i, c) = 6 * ((value(i + 1, c) - value(i, c)) / width(i) -
                         (value(i, c) - value(i - 1, c)) / width(i - 1));
    }
  }
  if (n == 3) {
    // Three knots carry one parabola: the curvature is the same at all.
    system(0, 0) = system(2, 2) = 1;
    system(0, 1) = system(2, 1) = -1;
  } else {
    // The third derivative is continuous across the second knot and the last but one.
    system.row(0).head(3) << width(1), -(width(0) + width(1)), width(0);
    system.row(n - 1).tail(3) << width(n - 2), -(width(n - 3) + width(n - 2)), width(n - 3);
  }
  return system.partialPivLu().solve(right);
}

}  // namespace

DeflectionCurve mean_of_sections(std::span<const double> x,
                                 std::span<const std::vector<std::int32_t>> sections,
                                 std::span<const double> displacement, int dim) {
  const auto components = static_cast<std::size_t>(dim);
  DeflectionCurve curve;
  curve.dim = dim;
  curve.x.assign(x.begin(), x.end());
  for (const std::vector<std::int32_t>& nodes : sections) {
    std::array<double, 3> mean{};
    for (const std::int32_t node : nodes) {
      for (std::size_t c = 0; c < components; ++c) {
        mean[c] += displacement[components * static_cast<std::size_t>(node) + c];
      }
    }
    for (double& component : mean) component /= static_cast<double>(nodes.size());
    curve.displacement.push_back(mean);
  }
  return curve;
}

DeflectionCurve read_curve_csv(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw InputError(fmt::format("{}: the curve cannot be read: no such file", file.string()));
  }
  DeflectionCurve curve;
  bool header_seen = false;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (!header_seen) {
      if (line != curve_header(2) && line != curve_header(3)) {
        throw InputError(fmt::format("{}: '{}': the header must be '{}', or '{}' of a plane bar",
                                     where, line, curve_header(3), curve_header(2)));
      }
      curve.dim = line == curve_header(2) ? 2 : 3;
      header_seen = true;
      continue;
    }
    const auto [x, ux, uy, uz] = parse_row(line, curve.dim, where);
    if (!curve.x.empty() && x <= curve.x.back()) {
      throw InputError(fmt::format("{}: x = {}: must be greater than {}, the x before it", where, x,
                                   curve.x.back()));
    }
    curve.x.push_back(x);
    curve.displacement.push_back({ux, uy, uz});
  }
  if (curve.size() < 2) {
    throw InputError(fmt::format("{}: {} sections: a curve needs two or more below the header '{}'",
                                 file.string(), curve.size(), curve_header(curve.dim)));
  }
  return curve;
}

void write_curve_csv(const std::filesystem::path& file, const DeflectionCurve& curve,
                     const std::string& comment) {
  std::string text = fmt::format("# {}\n{}\n", comment, curve_header(curve.dim));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    text += fmt::format("{:.17g}", curve.x[i]);
    for (int c = 0; c < curve.dim; ++c) {
      text += fmt::format(",{:.17g}", curve.displacement[i][static_cast<std::size_t>(c)]);
    }
    text += '\n';
  }
  write_text_file(file, text);
}

DeflectionCurve interpolate(const DeflectionCurve& curve, std::span<const double> positions) {
  // Positions are computed as fractions of a length; let rounding not put them outside.
  const double slack = 1e-9 * (curve.x.back() - curve.x.front());
  const Eigen::MatrixXd curvatures = spline_curvatures(curve);
  DeflectionCurve result;
  result.dim = curve.dim;
  for (const double position : positions) {
    if (!(position >= curve.x.front() - slack && position <= curve.x.back() + slack)) {
      throw InputError(
          fmt::format("x = {} m is outside the reference curve, which reaches from {} "
                      "to {} m: name a curve of the same bar",
                      position, curve.x.front(), curve.x.back()));
    }
    const auto above = std::upper_bound(curve.x.begin() + 1, curve.x.end() - 1, position);
    const auto right = static_cast<std::size_t>(above - curve.x.begin());
    const std::size_t left = right - 1;
    const double width = curve.x[right] - curve.x[left];
    const double b = (position - curve.x[left]) / width;
    const double a = 1 - b;
    std::array<double, 3> value{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      value[c] = a * curve.displacement[left][c] + b * curve.displacement[right][c] +
                 width * width / 6 *
                     ((a * a * a - a) * curvatures(static_cast<Eigen::Index>(left), column) +
                      (b * b * b - b) * curvatures(static_cast<Eigen::Index>(right), column));
    }
    result.x.push_back(position);
    result.displacement.push_back(value);
  }
  return result;
}

CurveDistance distance(const DeflectionCurve& curve, const DeflectionCurve& reference) {
  if (curve.dim != reference.dim) {
    throw InputError(fmt::format("the reference curve has the columns '{}', the bar's '{}'",
                                 curve_header(reference.dim), curve_header(curve.dim)));
  }
  const DeflectionCurve expected = interpolate(reference, curve.x);
  CurveDistance result;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double difference = curve.deflection(i) - expected.deflection(i);
    result.mean += std::abs(difference) / static_cast<double>(curve.size());
    result.tip = difference;
  }
  return result;
}

}  // namespace elastogen::selector
