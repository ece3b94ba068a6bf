#include "runtime/mesh_order.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace elastogen {
namespace {

constexpr int bits = 21;  // of each coordinate: three fit into 64

struct BoundingBox {
  std::array<double, 3> low{};
  double size = 0;  ///< of the longest edge
};

BoundingBox bounding_box(const Mesh& mesh) {
  BoundingBox box;
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t i = 0; i < dim && !mesh.positions.empty(); ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = i; k < mesh.positions.size(); k += dim) {
      low = std::min(low, mesh.positions[k]);
      high = std::max(high, mesh.positions[k]);
    }
    box.low[i] = low;
    box.size = std::max(box.size, high - low);
  }
  return box;
}

/// Two zero bits behind every bit of the lower 21.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// Place on the curve of an element's centre.
std::uint64_t place(const Mesh& mesh, std::span<const std::int32_t> nodes, const BoundingBox& box) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::uint64_t code = 0;
  for (std::size_t i = 0; i < dim; ++i) {
    double centre = 0;
    for (const std::int32_t node : nodes) {
      centre += mesh.positions[dim * static_cast<std::size_t>(node) + i];
    }
    centre /= static_cast<double>(nodes.size());
    const double part = box.size > 0 ? (centre - box.low[i]) / box.size : 0;
    constexpr double last = (1 << bits) - 1;
    code |= spread(static_cast<std::uint64_t>(std::clamp(part, 0.0, 1.0) * last)) << i;
  }
  return code;
}

/// Values of each node from one place to another: `move(new, old)` are these, target first.
template <class Move>
Vector moved(const MeshOrder& order, const ConstVectorRef& vector, Move&& move) {
  Vector result(vector.size());
  const auto dim = vector.size() / static_cast<Eigen::Index>(order.nodes.size());
  for (std::size_t k = 0; k < order.nodes.size(); ++k) {
    const auto at_new = dim * static_cast<Eigen::Index>(k);
    const auto at_old = dim * static_cast<Eigen::Index>(order.nodes[k]);
    const auto [to, from] = move(at_new, at_old);
    result.segment(to, dim) = vector.segment(from, dim);
  }
  return result;
}

}  // namespace

MeshOrder order_along_curve(const Mesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  MeshOrder order;
  std::vector<bool> is_placed(mesh.num_nodes(), false);
  const auto place_node = [&](std::int32_t node) {
    if (is_placed[static_cast<std::size_t>(node)]) return;
    is_placed[static_cast<std::size_t>(node)] = true;
    order.nodes.push_back(node);
  };
  std::int32_t first = 0;  // element of the block
  for (const ElementBlock& block : mesh.blocks) {
    std::vector<std::pair<std::uint64_t, std::int32_t>> places;
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      places.emplace_back(place(mesh, block.element_nodes(e), box), static_cast<std::int32_t>(e));
    }
    std::sort(places.begin(), places.end());
    for (const auto& [code, e] : places) {
      order.elements.push_back(first + e);
      for (const std::int32_t node : block.element_nodes(static_cast<std::size_t>(e))) {
        place_node(node);
      }
    }
    first += static_cast<std::int32_t>(block.num_elements());
  }
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    place_node(static_cast<std::int32_t>(node));
  }
  return order;
}

Mesh reordered(const Mesh& mesh, const MeshOrder& order) {
  Mesh result = mesh;
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::vector<std::int32_t> new_number(mesh.num_nodes());
  for (std::size_t k = 0; k < order.nodes.size(); ++k) {
    const auto old = static_cast<std::size_t>(order.nodes[k]);
    new_number[old] = static_cast<std::int32_t>(k);
    for (std::size_t i = 0; i < dim; ++i) {
      result.positions[dim * k + i] = mesh.positions[dim * old + i];
    }
  }
  std::size_t first = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    ElementBlock& target = result.blocks[b];
    target.nodes.clear();
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const std::size_t old = static_cast<std::size_t>(order.elements[first + e]) - first;
      target.region[e] = block.region[old];
      for (const std::int32_t node : block.element_nodes(old)) {
        target.nodes.push_back(new_number[static_cast<std::size_t>(node)]);
      }
    }
    first += block.num_elements();
  }
  return result;
}

Vector to_order(const MeshOrder& order, const ConstVectorRef& vector) {
  return moved(order, vector, [](auto at_new, auto at_old) { return std::pair(at_new, at_old); });
}

Vector from_order(const MeshOrder& order, const ConstVectorRef& vector) {
  return moved(order, vector, [](auto at_new, auto at_old) { return std::pair(at_old, at_new); });
}

}  // namespace elastogen
