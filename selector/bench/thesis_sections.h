// Sections of the report that put our figures beside those of the thesis (thesis_tables.h).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace elastogen::selector {

/// One of our beams in bending.
///
/// The thesis's measure (sections 5.4.1.2 and 5.5.4): a deflection curve is the mean position of
/// the nodes of each section x = constant of the mesh; its distance to another is the mean, over
/// all its sections from the clamped one (which counts, with 0) to the free one, of the distance
/// between the curves. The thesis does not say whether a section stands at its x at rest or after
/// bending; here it is at rest: |u_z(x) - reference(x)|. At the tip that makes a difference of
/// 2.6 mm.
struct ThesisFigure {
  std::string element;  ///< "hexa8"
  std::size_t num_elements = 0;
  double mean_to_line = 0;       ///< to thesis_deflection [m]
  double mean_to_converged = 0;  ///< to the converged beam in three dimensions [m]
  double seconds = 0;            ///< wall, the same phases for all
};

/// The deflection of a beam: u_z [m] at the sections' x at rest [m], ascending.
struct ThesisCurve {
  std::string element;  ///< "hexa8"; for the converged beam anything
  std::size_t num_elements = 0;
  std::vector<double> x, uz;
};

/// Our counterpart to a row of table 6.7: distance of nodes [m] after torsion by half a turn to
/// those of `reference`.
struct TorsionFigure {
  std::string mesh;  ///< "hexa8, 48x6x6"
  std::string reference;
  double mean = 0, maximum = 0, minimum = 0;
};

/// mean over the sections of |u_z - thesis_deflection| [m]
[[nodiscard]] double mean_distance_to_line(const ThesisCurve& curve);

/// Table 6.6: the thesis's figures and ours by element and number of elements, each of ours also
/// against the converged beam.
/// @param converged_to_line  mean distance of the converged beam to the line [m]: what is below it
///                           in the thesis's measure is no precision
[[nodiscard]] std::string thesis_table_6_6_html(const std::vector<ThesisFigure>& figures,
                                                double converged_to_line);

/// Figures 6.12 to 6.15: for each element the whole beam and its end at each resolution, with the
/// line and the converged beam.
[[nodiscard]] std::string thesis_curves_html(const std::vector<ThesisCurve>& curves,
                                             const ThesisCurve& converged);

/// Figure 6.16: distance to the line, and to the converged beam, against time.
[[nodiscard]] std::string thesis_figure_6_16_html(const std::vector<ThesisFigure>& figures);

/// Table 6.7.
[[nodiscard]] std::string thesis_table_6_7_html(const std::vector<TorsionFigure>& figures);

}  // namespace elastogen::selector
