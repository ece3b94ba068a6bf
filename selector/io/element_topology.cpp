#include "selector/io/element_topology.h"

#include <fmt/format.h>
#include <vtkCellType.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "runtime/error.h"

namespace elastogen::selector {

namespace {

/// Faces of an element with nodes in the middle of its edges, from those of its corners.
std::vector<std::vector<int>> quadratic_faces(std::vector<std::vector<int>> faces,
                                              const std::vector<std::array<int, 2>>& edges,
                                              int num_corners) {
  for (std::vector<int>& face : faces) {
    const std::size_t corners = face.size();
    for (std::size_t c = 0; c < corners; ++c) {
      const int from = face[c], to = face[(c + 1) % corners];
      const auto edge = std::find_if(edges.begin(), edges.end(), [&](const auto& ends) {
        return ends == std::array{from, to} || ends == std::array{to, from};
      });
      face.push_back(num_corners + static_cast<int>(edge - edges.begin()));
    }
  }
  return faces;
}

/// The quadratic element on the corners of a linear one. Nodes are in VTK's order.
ElementTopology quadratic(std::string_view name, std::string_view plural,
                          const ElementTopology& linear, int vtk_cell_type,
                          std::vector<std::array<int, 2>> edges) {
  ElementTopology topology = linear;
  topology.element = name;
  topology.plural = plural;
  topology.linear = linear.element;
  topology.num_nodes += static_cast<int>(edges.size());
  topology.vtk_cell_type = vtk_cell_type;
  topology.vtk_order.resize(static_cast<std::size_t>(topology.num_nodes));
  std::iota(topology.vtk_order.begin(), topology.vtk_order.end(), 0);
  topology.faces = quadratic_faces(linear.faces, edges, linear.num_nodes);
  topology.edges = std::move(edges);
  return topology;
}

std::vector<ElementTopology> with_quadratic(std::vector<ElementTopology> linear) {
  const auto of = [&](std::string_view name) -> const ElementTopology& {
    return *std::find_if(linear.begin(), linear.end(),
                         [&](const ElementTopology& t) { return t.element == name; });
  };
  std::vector<ElementTopology> all = linear;
  all.push_back(quadratic("hexa20", "quadratic hexahedra", of("hexa8"), VTK_QUADRATIC_HEXAHEDRON,
                          {{0, 1},
                           {1, 2},
                           {2, 3},
                           {3, 0},
                           {4, 5},
                           {5, 6},
                           {6, 7},
                           {7, 4},
                           {0, 4},
                           {1, 5},
                           {2, 6},
                           {3, 7}}));
  all.push_back(quadratic("tet10", "quadratic tetrahedra", of("tet4"), VTK_QUADRATIC_TETRA,
                          {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}));
  return all;
}

}  // namespace

const std::vector<ElementTopology>& element_topologies() {
  static const std::vector<ElementTopology> topologies = with_quadratic({
      // VTK wants the first triangle of a wedge to face away from the second, ours faces it.
      {"prism6",
       "prisms",
       3,
       6,
       VTK_WEDGE,
       {0, 2, 1, 3, 5, 4},
       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {"pyramid5",
       "pyramids",
       3,
       5,
       VTK_PYRAMID,
       {0, 1, 2, 3, 4},
       {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {"hexa8",
       "hexahedra",
       3,
       8,
       VTK_HEXAHEDRON,
       {0, 1, 2, 3, 4, 5, 6, 7},
       {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {"tet4",
       "tetrahedra",
       3,
       4,
       VTK_TETRA,
       {0, 1, 2, 3},
       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
      {"quad4", "quadrilaterals", 2, 4, VTK_QUAD, {0, 1, 2, 3}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {"tri3", "triangles", 2, 3, VTK_TRIANGLE, {0, 1, 2}, {{0, 1}, {1, 2}, {2, 0}}},
  });
  return topologies;
}

const ElementTopology& element_topology(const std::string& element) {
  std::string known;
  for (const ElementTopology& topology : element_topologies()) {
    if (topology.element == element) return topology;
    if (!known.empty()) known += ", ";
    known += topology.element;
  }
  throw InputError(
      fmt::format("element '{}' cannot be used in a mesh: these can: {}", element, known));
}

}  // namespace elastogen::selector
