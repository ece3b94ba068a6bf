#include "selector/io/coincident_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "selector/io/element_topology.h"

namespace elastogen::selector {
namespace {

constexpr double nearness = 1e-4;  // parts of an edge

using Point = std::array<double, 3>;

Point point_of(const Mesh& mesh, std::size_t node) {
  Point point{};
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::copy_n(&mesh.positions[dim * node], dim, point.begin());
  return point;
}

double distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// The shortest edge at each node; infinite at nodes of no element.
std::vector<double> shortest_edges(const Mesh& mesh) {
  std::vector<double> shortest(mesh.num_nodes(), std::numeric_limits<double>::infinity());
  for (const ElementBlock& block : mesh.blocks) {
    const ElementTopology& topology = element_topology(block.element);
    for (const std::vector<int>& face : topology.faces) {
      const std::vector<int> around = around_face(face);
      for (std::size_t e = 0; e < block.num_elements(); ++e) {
        const auto nodes = block.element_nodes(e);
        for (std::size_t i = 0; i < around.size(); ++i) {
          const auto a = static_cast<std::size_t>(nodes[static_cast<std::size_t>(around[i])]);
          const auto b = static_cast<std::size_t>(
              nodes[static_cast<std::size_t>(around[(i + 1) % around.size()])]);
          const double length = distance(point_of(mesh, a), point_of(mesh, b));
          shortest[a] = std::min(shortest[a], length);
          shortest[b] = std::min(shortest[b], length);
        }
      }
    }
  }
  return shortest;
}

}  // namespace

CoincidentNodes find_coincident_nodes(const Mesh& mesh) {
  CoincidentNodes result;
  if (mesh.num_nodes() == 0) return result;
  const std::vector<double> shortest = shortest_edges(mesh);
  // Along a line in no special direction few nodes of a mesh, however regular, lie near each other.
  const Point origin = point_of(mesh, 0);
  std::vector<double> along(mesh.num_nodes());
  for (std::size_t node = 0; node < along.size(); ++node) {
    const Point at = point_of(mesh, node);
    along[node] =
        0.7310 * (at[0] - origin[0]) + 0.5617 * (at[1] - origin[1]) + 0.3874 * (at[2] - origin[2]);
  }
  std::vector<std::size_t> order(mesh.num_nodes());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return along[a] < along[b]; });

  // The first node that each lies on; its own number where there is none.
  std::vector<std::size_t> lies_on(mesh.num_nodes());
  std::iota(lies_on.begin(), lies_on.end(), std::size_t{0});
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t a = order[i];
    if (!std::isfinite(shortest[a])) continue;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const std::size_t b = order[j];
      if (along[b] - along[a] > nearness * shortest[a]) break;
      if (!(distance(point_of(mesh, a), point_of(mesh, b)) <=
            nearness * std::min(shortest[a], shortest[b]))) {
        continue;
      }
      const auto [low, high] = std::minmax(a, b);
      lies_on[high] = std::min(lies_on[high], low);
    }
  }
  for (std::size_t node = 0; node < lies_on.size(); ++node) {
    if (lies_on[node] == node) continue;
    if (result.count++ == 0) result.first = {lies_on[node], node};
  }
  return result;
}

}  // namespace elastogen::selector
