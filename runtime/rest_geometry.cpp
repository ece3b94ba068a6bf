#include "runtime/rest_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace elastogen {
namespace {

// Nodes of a box in halves of its edges, in the order of hexa20; the first eight are those of
// hexa8, the first four those of a rectangle, quad4.
using BoxNode = std::array<int, 3>;
constexpr std::array<BoxNode, 20> box_nodes = {
    {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
     {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
     {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}};

bool may_be_box(const Mesh& mesh, const ElementBlock& block) {
  if (mesh.dim == 2) return block.element == "quad4";
  return block.element == "hexa8" || block.element == "hexa20";
}

// Corners at the ends of a tetrahedron's edges, in the order of the nodes of tet10 in their middle.
constexpr std::array<std::array<std::size_t, 2>, 6> tetrahedron_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

// Size of an element: largest extent along an axis, and largest coordinate.
struct Size {
  double extent = 0;
  double coordinate = 0;
};

Size element_size(const ElementGroup<double>& group, const Mesh& mesh, std::size_t batch,
                  std::size_t lane) {
  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  const std::int32_t* dofs = group.dofs.data() + batch * nodes * lanes + lane;
  Size size;
  for (int i = 0; i < group.dim; ++i) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t a = 0; a < nodes; ++a) {
      const double value = mesh.positions[static_cast<std::size_t>(dofs[a * lanes] + i)];
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

[[noreturn]] void refuse(const ElementGroup<double>& group, const BadShape& bad) {
  const bool inverted = bad.determinant < -bad.smallest;
  throw InputError(fmt::format(
      "{}: its rest shape is {}: the Jacobian determinant at quadrature point {} of {} is {:.6g}, "
      "must be greater than {:.2g}; {}",
      element_text(group, {}, bad.k), inverted ? "inverted" : "degenerate", bad.point + 1,
      group.table->num_points, bad.determinant, bad.smallest,
      inverted ? "list its nodes in the order of the element's definition, or repair the mesh"
               : "move its nodes apart, or remove it from the mesh"));
}

}  // namespace

std::vector<int> box_node_order(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  if (!may_be_box(mesh, block)) return {};
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
        if (axis[d] == i) expected += 0.5 * box_nodes[a][d] * edge[d][i];
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
    BoxNode node{};
    for (std::size_t d = 0; d < dim; ++d) {
      node[axis[d]] = edge[d][axis[d]] > 0 ? box_nodes[a][d] : 2 - box_nodes[a][d];
    }
    const auto at = std::find(box_nodes.begin(), box_nodes.end(), node);
    order[static_cast<std::size_t>(at - box_nodes.begin())] = static_cast<int>(a);
  }
  return order;
}

bool has_straight_edges(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  if (block.element != "tet10") return false;
  const std::span<const std::int32_t> nodes = block.element_nodes(element);
  const auto position = [&](std::size_t a, std::size_t i) {
    return mesh.positions[3 * static_cast<std::size_t>(nodes[a]) + i];
  };
  double longest = 0, farthest = 0;
  for (std::size_t k = 0; k < tetrahedron_edges.size(); ++k) {
    const auto [a, b] = tetrahedron_edges[k];
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, std::abs(position(b, i) - position(a, i)));
      const double middle = (position(a, i) + position(b, i)) / 2;
      farthest = std::max(farthest, std::abs(position(4 + k, i) - middle));
    }
  }
  return farthest <= 1e-12 * longest;
}

std::optional<std::vector<int>> node_order_for(const std::string& geometry, const Mesh& mesh,
                                               const ElementBlock& block, std::size_t element) {
  if (geometry == "box") {
    std::vector<int> order = box_node_order(mesh, block, element);
    return order.empty() ? std::nullopt : std::optional(std::move(order));
  }
  if (geometry == "affine" && !has_straight_edges(mesh, block, element)) return std::nullopt;
  return std::vector<int>();
}

template <class Scalar>
const VariantTable<Scalar>* find_variant(const KernelTable<Scalar>& table,
                                         const std::string& geometry) {
  for (std::int32_t v = 0; v < table.num_variants; ++v) {
    if (geometry == table.variants[v].geometry) return &table.variants[v];
  }
  return nullptr;
}

void measure_rest_shapes(const ElementGroup<double>& group, const Mesh& mesh,
                         RestMeasures measures) {
  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  const std::size_t points = static_cast<std::size_t>(group.table->num_points);
  AlignedVector<double> out((2 * nodes + points) * lanes);
  std::optional<BadShape> first_bad;
  for (std::size_t batch = 0; batch < group.num_batches; ++batch) {
    KernelArguments<double> arguments = group.arguments(batch);
    arguments.output = out.data();
    group.kernels->geometry_measures(&arguments, 1);
    const std::size_t used = static_cast<std::size_t>(group.used_lanes(batch));
    for (std::size_t lane = 0; lane < used; ++lane) {
      const std::size_t k = batch * lanes + lane;
      const double smallest =
          smallest_determinant(element_size(group, mesh, batch, lane), group.dim);
      for (int q = group.table->num_points - 1; q >= 0; --q) {
        const double determinant = out[(2 * nodes + static_cast<std::size_t>(q)) * lanes + lane];
        const bool first = !first_bad || group.elements[k] <= group.elements[first_bad->k];
        if (!(determinant > smallest) && first) first_bad = {k, q, determinant, smallest};
      }
      double volume = 0;
      for (std::size_t a = 0; a < nodes; ++a) {
        const double share = out[a * lanes + lane];
        const std::size_t node =
            static_cast<std::size_t>(group.dofs[(batch * nodes + a) * lanes + lane] / group.dim);
        measures.nodal_volumes[node] += share;
        measures.nodal_mass[node] += group.density * share;
        measures.lumped_mass[node] += group.density * out[(nodes + a) * lanes + lane];
        volume += share;
      }
      measures.element_volumes[static_cast<std::size_t>(group.elements[k])] = volume;
    }
  }
  if (first_bad) refuse(group, *first_bad);
}

template <class Scalar>
std::string element_text(const ElementGroup<Scalar>& group, const NodeNumbering& numbering,
                         std::size_t k) {
  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  Mesh named;
  named.numbers = group.numbers;
  std::string list;
  for (std::size_t a = 0; a < nodes; ++a) {
    const std::int32_t dof = group.dofs[(k / lanes * nodes + a) * lanes + k % lanes];
    const std::int32_t node = numbering.node_of_mesh(dof / group.dim);
    list += fmt::format(" {}", named.node_number(static_cast<std::size_t>(node)));
  }
  return fmt::format("element {} ({}, nodes{})",
                     named.element_number(static_cast<std::size_t>(group.elements[k])),
                     group.table->element, list);
}

template const VariantTable<double>* find_variant(const KernelTable<double>&, const std::string&);
template const VariantTable<float>* find_variant(const KernelTable<float>&, const std::string&);
template std::string element_text(const ElementGroup<double>&, const NodeNumbering&, std::size_t);
template std::string element_text(const ElementGroup<float>&, const NodeNumbering&, std::size_t);

}  // namespace elastogen
