#include "selector/scene/select_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "runtime/error.h"
#include "selector/support/names.h"

namespace elastogen::selector {

const MeshBoundary& find_boundary(const SceneMesh& mesh, const NodeSelection& selection) {
  std::vector<std::string> names;
  for (const MeshBoundary& boundary : mesh.boundaries) {
    if (boundary.name == selection.boundary) return boundary;
    names.push_back(boundary.name);
  }
  const std::vector<std::string>& regions = mesh.mesh.region_names;
  const bool is_region =
      std::find(regions.begin(), regions.end(), selection.boundary) != regions.end();
  const std::string advice =
      (is_region ? "; the region of this name is no boundary" : "") +
      (mesh.boundary_advice.empty() ? "" : "; a boundary is " + mesh.boundary_advice);
  if (names.empty()) {
    throw InputError(fmt::format("{}: {}: the mesh has no boundaries: select by plane or box{}",
                                 selection.where, selection.description, advice));
  }
  throw InputError(fmt::format("{}: {}: the mesh has none of this name{}; it has: {}{}",
                               selection.where, selection.description,
                               did_you_mean(selection.boundary, names), join(names, ", "), advice));
}

std::vector<std::int32_t> select_nodes(const SceneMesh& scene_mesh,
                                       const NodeSelection& selection) {
  if (!selection.boundary.empty()) return find_boundary(scene_mesh, selection).nodes;
  const Mesh& mesh = scene_mesh.mesh;
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::array<double, 3> low{}, high{};
  low.fill(no_limit);
  high.fill(-no_limit);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % dim] = std::min(low[i % dim], mesh.positions[i]);
    high[i % dim] = std::max(high[i % dim], mesh.positions[i]);
  }
  double extent = 0;
  for (std::size_t c = 0; c < dim; ++c) extent = std::max(extent, high[c] - low[c]);
  const double tolerance = 1e-6 * extent;

  std::vector<std::int32_t> nodes;
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    bool inside = true;
    for (std::size_t c = 0; c < dim; ++c) {
      const double x = mesh.positions[dim * node + c];
      inside =
          inside && x >= selection.minimum[c] - tolerance && x <= selection.maximum[c] + tolerance;
    }
    if (inside) nodes.push_back(static_cast<std::int32_t>(node));
  }
  if (nodes.empty()) {
    throw InputError(fmt::format("{}: {} selects no node: the mesh reaches from [{}] to [{}]",
                                 selection.where, selection.description,
                                 fmt::join(std::span(low).first(dim), ", "),
                                 fmt::join(std::span(high).first(dim), ", ")));
  }
  return nodes;
}

}  // namespace elastogen::selector
