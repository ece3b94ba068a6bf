#include "selector/scene/select_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/error.h"

namespace elastogen::selector {

std::vector<std::int32_t> select_nodes(const Mesh& mesh, const NodeSelection& selection) {
  std::array<double, 3> low{}, high{};
  low.fill(no_limit);
  high.fill(-no_limit);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const double tolerance = 1e-6 * extent;

  std::vector<std::int32_t> nodes;
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = mesh.positions[3 * node + c];
      inside =
          inside && x >= selection.minimum[c] - tolerance && x <= selection.maximum[c] + tolerance;
    }
    if (inside) nodes.push_back(static_cast<std::int32_t>(node));
  }
  if (nodes.empty()) {
    throw InputError(fmt::format(
        "{}: {} selects no node: the mesh reaches from [{}, {}, {}] to "
        "[{}, {}, {}]",
        selection.where, selection.description, low[0], low[1], low[2], high[0], high[1], high[2]));
  }
  return nodes;
}

}  // namespace elastogen::selector
