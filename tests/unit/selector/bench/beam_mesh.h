// Beams of one element type, also of quadratic elements, for tests of other solvers' decks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// Beam [0, 8] x [0, 1]^2 m in cells of one hexahedron, two prisms along x, or six tetrahedra.
/// @param element  "hexa8", "hexa20", "prism6", "tet4", "tet10"
inline Mesh beam_mesh(const std::string& element, std::array<int, 3> cells) {
  using Point = std::array<int, 3>;  // in half cells
  const std::vector<Point> cube = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                                   {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  std::vector<std::vector<Point>> parts;
  std::vector<std::array<int, 2>> edges;
  if (element.starts_with("hexa")) {
    parts = {cube};
    edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
             {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  } else if (element == "prism6") {
    parts = {{cube[0], cube[3], cube[7], cube[1], cube[2], cube[6]},
             {cube[0], cube[7], cube[4], cube[1], cube[6], cube[5]}};
  } else {
    std::array<int, 3> axes = {0, 1, 2};
    do {
      std::vector<Point> tet = {{0, 0, 0}};
      for (const int axis : axes) {
        tet.push_back(tet.back());
        tet.back()[static_cast<std::size_t>(axis)] = 2;
      }
      const bool even = (axes[1] - axes[0] + 3) % 3 == 1;
      if (!even) std::swap(tet[1], tet[2]);
      parts.push_back(tet);
    } while (std::next_permutation(axes.begin(), axes.end()));
    edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  }
  if (element == "hexa20" || element == "tet10") {
    for (std::vector<Point>& part : parts) {
      for (const auto& [a, b] : edges) {
        const Point &p = part[static_cast<std::size_t>(a)], &q = part[static_cast<std::size_t>(b)];
        part.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
      }
    }
  }

  Mesh mesh;
  mesh.region_names = {"beam"};
  ElementBlock& block = mesh.blocks.emplace_back();
  block.element = element;
  block.nodes_per_element = static_cast<int>(parts.front().size());
  std::map<Point, std::int32_t> numbers;
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k)
        for (const std::vector<Point>& part : parts) {
          for (const Point& p : part) {
            const Point q = {2 * i + p[0], 2 * j + p[1], 2 * k + p[2]};
            const auto [at, added] = numbers.emplace(q, static_cast<std::int32_t>(numbers.size()));
            if (added) {
              const std::array<double, 3> size = {8, 1, 1};
              for (std::size_t c = 0; c < 3; ++c)
                mesh.positions.push_back(q[c] * size[c] / (2 * cells[c]));
            }
            block.nodes.push_back(at->second);
          }
          block.region.push_back(0);
        }
  return mesh;
}

/// Nodes at x, to rounding.
inline std::vector<std::size_t> section_nodes(const Mesh& mesh, double x) {
  std::vector<std::size_t> nodes;
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    if (std::abs(mesh.positions[3 * n] - x) < 1e-9) nodes.push_back(n);
  }
  return nodes;
}

}  // namespace elastogen::selector
