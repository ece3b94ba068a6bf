#include "runtime/rest_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace elastogen {
namespace {

// Corners of a box in the order of hexa8; the first four are those of a rectangle, quad4.
constexpr std::array<std::array<int, 3>, 8> box_corners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

// Size of an element: largest extent along an axis, and largest coordinate.
struct Size {
  double extent = 0;
  double coordinate = 0;
};

Size element_size(const ElementGroup& group, std::size_t batch, std::size_t lane) {
  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const double* x = group.positions.data() + batch * group.values_per_batch() + lane;
  Size size;
  for (int i = 0; i < group.dim; ++i) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int a = 0; a < group.num_nodes; ++a) {
      const double value = x[static_cast<std::size_t>(a * group.dim + i) * lanes];
      low = std::min(low, value);
      high = std::max(high, value);
    }
    size.extent = std::max(size.extent, high - low);
    size.coordinate = std::max({size.coordinate, std::abs(low), std::abs(high)});
  }
  return size;
}

// A determinant below this cannot be told from 0: 1e-12 of a cube of the element's size, or what
// rounding of the coordinates does to it.
double smallest_determinant(const Size& size, int dim) {
  const double relative = 1e-12 * size.extent;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * size.coordinate;
  return std::max(relative, rounding) * std::pow(size.extent, dim - 1);
}

// A rest shape that is not sound.
struct BadShape {
  std::size_t k = 0;  // lane of the group
  int point = 0;
  double determinant = 0;
  double smallest = 0;
};

[[noreturn]] void refuse(const ElementGroup& group, const BadShape& bad) {
  const bool inverted = bad.determinant < -bad.smallest;
  throw InputError(fmt::format(
      "{}: its rest shape is {}: the Jacobian determinant at quadrature point {} of {} is {:.6g}, "
      "must be greater than {:.2g}; {}",
      element_text(group, bad.k), inverted ? "inverted" : "degenerate", bad.point + 1,
      group.table->num_points, bad.determinant, bad.smallest,
      inverted ? "list its nodes in the order of the element's definition, or repair the mesh"
               : "move its nodes apart, or remove it from the mesh"));
}

}  // namespace

std::vector<int> box_node_order(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  const bool may_be_box = mesh.dim == 3 ? block.element == "hexa8" : block.element == "quad4";
  if (!may_be_box) return {};
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const std::span<const std::int32_t> nodes = block.element_nodes(element);
  const auto position = [&](std::size_t a, std::size_t i) {
    return mesh.positions[dim * static_cast<std::size_t>(nodes[a]) + i];
  };
  // Edges from node 0 along the element's own coordinates, which must lie along the axes.
  constexpr std::array<std::size_t, 3> neighbours = {1, 3, 4};
  std::array<std::array<double, 3>, 3> edge{};
  std::array<std::size_t, 3> axis{};
  double longest = 0;
  for (std::size_t d = 0; d < dim; ++d) {
    for (std::size_t i = 0; i < dim; ++i) {
      edge[d][i] = position(neighbours[d], i) - position(0, i);
      if (std::abs(edge[d][i]) > std::abs(edge[d][axis[d]])) axis[d] = i;
    }
    longest = std::max(longest, std::abs(edge[d][axis[d]]));
  }
  const double tolerance = 1e-12 * longest;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t i = 0; i < dim; ++i) {
      double expected = position(0, i);
      for (std::size_t d = 0; d < dim; ++d) {
        if (axis[d] == i) expected += box_corners[a][d] * edge[d][i];
      }
      if (!(std::abs(position(a, i) - expected) <= tolerance)) return {};
    }
  }
  // Turned, not mirrored: the permutation of the axes times their directions is even.
  int orientation = 1;
  for (std::size_t d = 0; d < dim; ++d) {
    if (edge[d][axis[d]] == 0) return {};
    if (edge[d][axis[d]] < 0) orientation = -orientation;
    for (std::size_t e = 0; e < d; ++e) {
      if (axis[e] == axis[d]) return {};
      if (axis[e] > axis[d]) orientation = -orientation;
    }
  }
  if (orientation < 0) return {};
  std::vector<int> order(nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    std::array<int, 3> corner{};
    for (std::size_t d = 0; d < dim; ++d) {
      corner[axis[d]] = edge[d][axis[d]] > 0 ? box_corners[a][d] : 1 - box_corners[a][d];
    }
    const auto at = std::find(box_corners.begin(), box_corners.end(), corner);
    order[static_cast<std::size_t>(at - box_corners.begin())] = static_cast<int>(a);
  }
  return order;
}

const VariantTable<double>* find_variant(const KernelTable<double>& table,
                                         const std::string& geometry) {
  for (std::int32_t v = 0; v < table.num_variants; ++v) {
    if (geometry == table.variants[v].geometry) return &table.variants[v];
  }
  return nullptr;
}

void measure_rest_shapes(const ElementGroup& group, RestMeasures measures) {
  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  AlignedVector<double> out((nodes + static_cast<std::size_t>(group.table->num_points)) * lanes);
  std::optional<BadShape> first_bad;
  for (std::size_t batch = 0; batch < group.num_batches; ++batch) {
    KernelArguments<double> arguments = group.arguments(batch);
    arguments.output = out.data();
    group.kernels->geometry_measures(arguments);
    const std::size_t used = static_cast<std::size_t>(group.used_lanes(batch));
    for (std::size_t lane = 0; lane < used; ++lane) {
      const std::size_t k = batch * lanes + lane;
      const double smallest = smallest_determinant(element_size(group, batch, lane), group.dim);
      for (int q = group.table->num_points - 1; q >= 0; --q) {
        const double determinant = out[(nodes + static_cast<std::size_t>(q)) * lanes + lane];
        const bool first = !first_bad || group.elements[k] <= group.elements[first_bad->k];
        if (!(determinant > smallest) && first) first_bad = {k, q, determinant, smallest};
      }
      double volume = 0;
      for (std::size_t a = 0; a < nodes; ++a) {
        const double share = out[a * lanes + lane];
        const std::size_t node =
            static_cast<std::size_t>(group.dofs[(batch * nodes + a) * lanes + lane] / group.dim);
        measures.nodal_volumes[node] += share;
        measures.lumped_mass[node] += group.density * share;
        volume += share;
      }
      measures.element_volumes[static_cast<std::size_t>(group.elements[k])] = volume;
    }
  }
  if (first_bad) refuse(group, *first_bad);
}

std::string element_text(const ElementGroup& group, std::size_t k) {
  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  std::string list;
  for (std::size_t a = 0; a < nodes; ++a) {
    list += fmt::format(" {}", group.dofs[(k / lanes * nodes + a) * lanes + k % lanes] / group.dim);
  }
  return fmt::format("element {} ({}, nodes{})", group.elements[k], group.table->element, list);
}

}  // namespace elastogen
