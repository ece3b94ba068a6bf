#include "selector/io/deformed_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "selector/io/colours.h"
#include "selector/io/element_topology.h"
#include "selector/io/gnuplot.h"
#include "selector/io/mesh_faces.h"
#include "selector/io/projection.h"
#include "selector/io/si_prefix.h"

namespace elastogen::selector {
namespace {

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

constexpr double element_shrink = 0.84;  // about the element's centre
constexpr double fill_shrink = 0.84;     // of a face's filling inside its edge
constexpr int picture_width = 1500;      // pixels
constexpr double margin_left = 60, margin_right = 150, margin_top = 95, margin_bottom = 20;

/// A convex element as it is drawn.
struct DrawnElement {
  const ElementTopology* topology = nullptr;
  std::vector<Vector3d> nodes;  // deformed and shrunk
  std::vector<double> values;   // per node
  double nearness = 0;
};

/// In space; z = 0 in the plane.
Vector3d point_of(std::span<const double> values, int dim, std::int32_t node) {
  Vector3d point = Vector3d::Zero();
  for (int c = 0; c < dim; ++c) point[c] = values[static_cast<std::size_t>(dim * node + c)];
  return point;
}

/// Which nodes lie on the surface: elements without one are hidden. In the plane nothing is.
std::vector<bool> nodes_on_surface(const Mesh& mesh) {
  std::vector<bool> on_surface(mesh.num_nodes(), mesh.dim == 2);
  if (mesh.dim == 2) return on_surface;
  const FaceMatching matching = match_faces(mesh);
  for (const std::size_t i : surface_faces(matching)) {
    for (const std::int32_t node : matching.boundary[i].nodes) {
      on_surface[static_cast<std::size_t>(node)] = true;
    }
  }
  return on_surface;
}

/// Elements near the surface, the farthest first.
/// @param values  of each element's nodes
std::vector<DrawnElement> drawn_elements(const Mesh& mesh, std::span<const double> displacement,
                                         std::span<const double> values,
                                         const Projection& projection) {
  const std::vector<bool> on_surface = nodes_on_surface(mesh);
  std::vector<DrawnElement> elements;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const auto nodes = block.element_nodes(e);
      const auto its_values = values.first(nodes.size());
      values = values.subspan(nodes.size());
      if (std::none_of(nodes.begin(), nodes.end(), [&](std::int32_t node) {
            return on_surface[static_cast<std::size_t>(node)];
          })) {
        continue;
      }
      DrawnElement element{
          &element_topology(block.element), {}, {its_values.begin(), its_values.end()}, 0};
      Vector3d centre = Vector3d::Zero();
      for (const std::int32_t node : nodes) {
        element.nodes.push_back(point_of(mesh.positions, mesh.dim, node) +
                                point_of(displacement, mesh.dim, node));
        centre += element.nodes.back() / static_cast<double>(nodes.size());
      }
      for (Vector3d& node : element.nodes) node = centre + element_shrink * (node - centre);
      element.nearness = projection.nearness(centre);
      elements.push_back(std::move(element));
    }
  }
  std::stable_sort(elements.begin(), elements.end(),
                   [](const auto& a, const auto& b) { return a.nearness < b.nearness; });
  return elements;
}

void append_polygon(const std::vector<Eigen::Vector2d>& corners, const Colour& colour,
                    std::string& data) {
  const int rgb = rgb_number(colour);
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const Eigen::Vector2d& corner = corners[i % corners.size()];
    data += fmt::format("{:.6g} {:.6g} {}\n", corner[0], corner[1], rgb);
  }
  data += '\n';
}

/// What is filled of an element: its faces, of a plane one the whole.
std::vector<std::vector<int>> polygons(const ElementTopology& topology) {
  if (topology.dim == 3) {
    std::vector<std::vector<int>> around;
    for (const std::vector<int>& face : topology.faces) around.push_back(around_face(face));
    return around;
  }
  std::vector<int> all(static_cast<std::size_t>(topology.num_nodes));
  std::iota(all.begin(), all.end(), 0);
  return {all};
}

/// What colours stand for.
struct ColourRange {
  double low = 0, high = 1;

  [[nodiscard]] Colour colour(double value) const {
    if (!std::isfinite(value)) return {0.7, 0.7, 0.7};
    return sequential_colour((value - low) / (high - low));
  }
};

ColourRange range_of(const std::vector<DrawnElement>& elements, bool from_zero) {
  ColourRange range{INFINITY, -INFINITY};
  for (const DrawnElement& element : elements) {
    for (const double value : element.values) {
      if (!std::isfinite(value)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  }
  if (range.low > range.high) return {};
  if (from_zero && range.low >= 0) range.low = 0;
  // A body of one value: colours need a range around it.
  if (range.high - range.low <= 1e-9 * std::max(std::abs(range.low), std::abs(range.high))) {
    const double around = range.high == 0 ? 1 : 0.01 * std::abs(range.high);
    range = {range.low - around, range.high + around};
  }
  return range;
}

/// The faces of an element that look at the eye: an edge-coloured polygon, and on it a smaller one
/// filled by the mean value, darker the more the face turns away from the light.
void append_faces(const DrawnElement& element, const Projection& projection,
                  const ColourRange& range, std::string& data) {
  const Vector3d light =
      (projection.to_eye + 0.8 * projection.up - 0.3 * projection.right).normalized();
  for (const std::vector<int>& face : polygons(*element.topology)) {
    std::vector<Eigen::Vector2d> corners;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    double value = 0;
    for (const int local : face) {
      const auto node = static_cast<std::size_t>(local);
      corners.push_back(projection(element.nodes[node]));
      middle += corners.back() / static_cast<double>(face.size());
      value += element.values[node] / static_cast<double>(face.size());
    }
    const auto at = [&](std::size_t i) { return element.nodes[static_cast<std::size_t>(face[i])]; };
    const Vector3d normal = (at(1) - at(0)).cross(at(face.size() - 1) - at(0)).normalized();
    if (normal.dot(projection.to_eye) <= 0) continue;

    const double brightness = 0.6 + 0.4 * std::max(0.0, normal.dot(light));
    append_polygon(corners, shaded(shape_colour(element.topology->element), brightness), data);
    for (Eigen::Vector2d& corner : corners) corner = middle + fill_shrink * (corner - middle);
    append_polygon(corners, shaded(range.colour(value), brightness), data);
  }
}

/// A round number of which about five fit into a length.
double tick_step(double length) {
  const double raw = length / 5;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

/// The box at rest as thin lines, with ticks along its upper x edge at the back, where a body that
/// hangs down does not cover them, and the other sizes at the end x = least.
std::string axes_script(const Box& rest, int dim, const Projection& projection) {
  std::string script;
  const auto line = [&](const Vector3d& from, const Vector3d& to, const char* colour) {
    const Eigen::Vector2d a = projection(from), b = projection(to);
    script += fmt::format("set arrow from {:.6g},{:.6g} to {:.6g},{:.6g} nohead lc rgb '{}' back\n",
                          a[0], a[1], b[0], b[1], colour);
  };
  const auto label = [&](const Vector3d& where, const std::string& text,
                         const char* justification) {
    const Eigen::Vector2d at = projection(where);
    script += fmt::format("set label {} at {:.6g},{:.6g} {} front\n", gnuplot_quoted(text), at[0],
                          at[1], justification);
  };
  for (int corner = 0; corner < 1 << dim; ++corner) {
    for (int axis = 0; axis < dim; ++axis) {
      if (corner >> axis & 1) continue;
      line(rest.corner(static_cast<Box::CornerType>(corner)),
           rest.corner(static_cast<Box::CornerType>(corner | 1 << axis)), "#b0b0b0");
    }
  }
  const Vector3d low = rest.min(), size = rest.sizes();
  const double tick = 0.012 * size.maxCoeff();
  const double step = tick_step(size[0]);
  const Vector3d back(low[0], rest.max()[1], rest.max()[2]);
  for (double x = 0; x <= size[0] * (1 + 1e-9); x += step) {
    const Vector3d at = back + x * Vector3d::UnitX();
    line(at, at + tick * projection.up, "#404040");
    label(at + 2.2 * tick * projection.up, fmt::format("{:.4g}", at[0]), "center");
  }
  line(back, back + size[0] * Vector3d::UnitX(), "#404040");
  label(back + 0.5 * step * Vector3d::UnitX() + 2.2 * tick * projection.up, "x [m]", "center");
  const Vector3d aside = -0.7 * tick * projection.right;
  if (dim == 2) {
    label(low + 0.5 * size[1] * Vector3d::UnitY() + aside, fmt::format("y: {:.4g} m", size[1]),
          "right");
    return script;
  }
  label(low + 0.5 * size[2] * Vector3d::UnitZ() + aside, fmt::format("z: {:.4g} m", size[2]),
        "right");
  label(low + Vector3d(0, 0.5 * size[1], size[2]) + aside + tick * projection.up,
        fmt::format("y: {:.4g} m", size[1]), "right");
  return script;
}

/// Legend: one invisible curve per shape that occurs, with its count.
std::string legend_script(const Mesh& mesh) {
  std::map<std::string_view, std::size_t> counts;
  for (const ElementBlock& block : mesh.blocks) {
    counts[element_topology(block.element).element] += block.num_elements();
  }
  std::string script;
  for (const ElementTopology& topology : element_topologies()) {
    if (!counts.contains(topology.element)) continue;
    script += fmt::format(", NaN with points pt 5 ps 2.2 lc rgb '{}' title '{} {}'",
                          rgb_text(shape_colour(topology.element)), counts[topology.element],
                          topology.plural);
  }
  return script;
}

}  // namespace

PictureColours displacement_colours(const Mesh& mesh, std::span<const double> displacement) {
  PictureColours colours{"displacement", "m", {}, true};
  for (const ElementBlock& block : mesh.blocks) {
    for (const std::int32_t node : block.nodes) {
      colours.values.push_back(point_of(displacement, mesh.dim, node).norm());
    }
  }
  return colours;
}

void draw_deformed(const std::filesystem::path& picture, const Mesh& mesh,
                   std::span<const double> displacement, const PictureColours& colours,
                   const std::string& title) {
  const Projection projection =
      mesh.dim == 2
          ? Projection{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}
          : Projection::from_angles(28 * std::numbers::pi / 180, 20 * std::numbers::pi / 180);
  Box rest, whole;
  for (std::size_t i = 0; i < mesh.num_nodes(); ++i) {
    const auto node = static_cast<std::int32_t>(i);
    const Vector3d at = point_of(mesh.positions, mesh.dim, node),
                   moved = point_of(displacement, mesh.dim, node);
    rest.extend(at);
    whole.extend(at).extend(at + moved);
  }
  Eigen::AlignedBox2d frame;
  for (int corner = 0; corner < 8; ++corner) {
    frame.extend(projection(whole.corner(static_cast<Box::CornerType>(corner))));
  }
  const Eigen::Vector2d slack = Eigen::Vector2d::Constant(0.06 * frame.sizes().maxCoeff());
  frame = {frame.min() - slack, frame.max() + slack};
  const double scale = (picture_width - margin_left - margin_right) / frame.sizes()[0];
  const int height = static_cast<int>(
      std::clamp(frame.sizes()[1] * scale + margin_top + margin_bottom, 420.0, 1500.0));

  const std::vector<DrawnElement> elements =
      drawn_elements(mesh, displacement, colours.values, projection);
  const ColourRange range = range_of(elements, colours.from_zero);
  std::string script = "$faces << END\n";
  for (const DrawnElement& element : elements) append_faces(element, projection, range, script);
  script += "END\n";
  script += axes_script(rest, mesh.dim, projection);
  const double right = 1 - margin_right / picture_width;
  script += fmt::format(
      "set label {} at screen 0.5, screen {:.5f} center font ',17'\n"
      "set size ratio -1\nunset border\nunset tics\n"
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
      "set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
      gnuplot_quoted(title), 1 - 25.0 / height, margin_left / picture_width, right,
      1 - margin_top / height, margin_bottom / height, frame.min()[0], frame.max()[0],
      frame.min()[1], frame.max()[1]);
  const SiPrefix prefix = colours.unit.empty()
                              ? SiPrefix()
                              : si_prefix(std::max(std::abs(range.low), std::abs(range.high)));
  script += fmt::format(
      "set palette {}\nset cbrange [{:.6g}:{:.6g}]\nset cbtics\n"
      "set cblabel {}\n"
      "set colorbox user origin screen {:.5f}, screen 0.15 size screen 0.016, screen 0.65\n"
      "set key horizontal Left reverse center at screen 0.5, screen {:.5f} samplen 1.5\n"
      "set style fill solid 1 noborder\n"
      "plot $faces using 1:2:3 with filledcurves closed lc rgb variable notitle, "
      "NaN with points palette notitle{}\n",
      sequential_palette(), prefix.factor * range.low, prefix.factor * range.high,
      gnuplot_quoted(colours.unit.empty()
                         ? colours.title
                         : fmt::format("{} [{}{}]", colours.title, prefix.symbol, colours.unit)),
      right + 0.015, 1 - 62.0 / height, legend_script(mesh));
  draw_png(picture, picture_width, height, script);
}

}  // namespace elastogen::selector
