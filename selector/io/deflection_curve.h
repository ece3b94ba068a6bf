// Deflection curves: mean displacement of each section of a bar, and distances between curves.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace elastogen::selector {

/// Mean displacements of the sections x = constant of a bar, x ascending; metres. A bar deflects
/// along its last axis: z, in the plane y.
struct DeflectionCurve {
  int dim = 3;  ///< 2: a plane bar; uz is 0
  std::vector<double> x;
  std::vector<std::array<double, 3>> displacement;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] double deflection(std::size_t i) const {
    return displacement[i][static_cast<std::size_t>(dim - 1)];
  }
  [[nodiscard]] std::string deflection_name() const { return dim == 2 ? "u_y" : "u_z"; }
};

/// Mean over the nodes of each section.
///
/// @param x             position of each section
/// @param sections      nodes of each section, at least one each
/// @param displacement  [dim * node + component], metres
[[nodiscard]] DeflectionCurve mean_of_sections(std::span<const double> x,
                                               std::span<const std::vector<std::int32_t>> sections,
                                               std::span<const double> displacement, int dim);

/// Reads a curve: lines that start with '#' are comments, then the header `x,ux,uy,uz`, of a plane
/// bar `x,ux,uy`, then one line of as many numbers per section, x strictly ascending, two sections
/// or more.
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] DeflectionCurve read_curve_csv(const std::filesystem::path& file);

/// Writes a curve in the same form, 17 digits, atomically.
/// @param comment  one line, without '#'
void write_curve_csv(const std::filesystem::path& file, const DeflectionCurve& curve,
                     const std::string& comment);

/// The curve at other positions, by the cubic spline through its sections with the not-a-knot
/// condition (linear for two sections, parabolic for three): between the sections of a smooth
/// deflection the error falls with the fourth power of their distance.
/// @throws InputError  for a position outside the curve
[[nodiscard]] DeflectionCurve interpolate(const DeflectionCurve& curve,
                                          std::span<const double> positions);

/// How far a curve's deflections u are from a reference's.
struct CurveDistance {
  double mean = 0;  ///< mean of |u - reference| over the sections [m], as in thesis table 6.6
  double tip = 0;   ///< u - reference at the last section [m], with its sign
};

/// Compares at the sections of `curve`; the reference is interpolated there.
/// @throws InputError  when the reference does not reach from the first section to the last, or is
///                     of another dimension
[[nodiscard]] CurveDistance distance(const DeflectionCurve& curve,
                                     const DeflectionCurve& reference);

}  // namespace elastogen::selector
