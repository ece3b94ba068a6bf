// Small meshes and bodies for the runtime's tests.
#pragma once

#include <array>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "runtime/constraints.h"
#include "runtime/mesh.h"
#include "runtime/model.h"
#include "runtime/vector.h"
#include "tests/unit/runtime/reference_kernels.h"

namespace elastogen::test {

/// Edges of a block of small elements, m.
inline constexpr std::array<double, 3> block_lengths = {2, 1, 1.5};

/// Lame parameters of a material with Young's modulus 1e5 Pa and Poisson's ratio 0.3.
inline std::vector<double> lame_parameters() {
  constexpr double young = 1e5;
  constexpr double poisson = 0.3;
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

/// A bar [0, lx] x [0, ly] x [0, lz] of nx x ny x nz cells, as hexa8 or as six tet4 per cell.
/// Nodes are numbered z fastest; x = 0 comes first.
inline Mesh bar_mesh(const std::string& element, std::array<int, 3> cells,
                     std::array<double, 3> lengths) {
  Mesh mesh;
  mesh.region_names = {"bar"};
  const int nx = cells[0], ny = cells[1], nz = cells[2];
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      for (int k = 0; k <= nz; ++k) {
        mesh.positions.insert(mesh.positions.end(),
                              {lengths[0] * i / nx, lengths[1] * j / ny, lengths[2] * k / nz});
      }
    }
  }
  ElementBlock block;
  block.element = element;
  block.nodes_per_element = element == "tet4" ? 4 : 8;
  const auto node = [&](int i, int j, int k) { return (i * (ny + 1) + j) * (nz + 1) + k; };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        const std::array<std::int32_t, 8> c = {node(i, j, k),
                                               node(i + 1, j, k),
                                               node(i + 1, j + 1, k),
                                               node(i, j + 1, k),
                                               node(i, j, k + 1),
                                               node(i + 1, j, k + 1),
                                               node(i + 1, j + 1, k + 1),
                                               node(i, j + 1, k + 1)};
        if (element == "hexa8") {
          block.nodes.insert(block.nodes.end(), c.begin(), c.end());
          block.region.push_back(0);
          continue;
        }
        // Six tetrahedra around the diagonal from corner 0 to corner 6.
        constexpr int ring[7] = {1, 2, 3, 7, 4, 5, 1};
        for (int t = 0; t < 6; ++t) {
          block.nodes.insert(block.nodes.end(), {c[0], c[ring[t]], c[ring[t + 1]], c[6]});
          block.region.push_back(0);
        }
      }
    }
  }
  mesh.blocks.push_back(block);
  return mesh;
}

/// Moves every inner node by a random part of `amount`.
inline void distort(Mesh& mesh, std::array<double, 3> lengths, double amount, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-amount, amount);
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    bool inner = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = mesh.positions[3 * node + i];
      inner = inner && x > 1e-9 && x < lengths[i] - 1e-9;
    }
    for (std::size_t i = 0; i < 3 && inner; ++i) mesh.positions[3 * node + i] += random(generator);
  }
}

/// The parts of a mesh of one block: all its elements by one table.
inline std::vector<ModelPart> one_part(const Mesh& mesh, const KernelTable<double>& table,
                                       double density = 1000) {
  ModelPart part;
  part.elements = elements_of_region(mesh.blocks[0], 0);
  part.kernels = &table;
  part.parameters = lame_parameters();
  part.density = density;
  return {part};
}

inline Vector random_vector(std::size_t size, double amount, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-amount, amount);
  Vector v(static_cast<Eigen::Index>(size));
  for (double& value : v) value = random(generator);
  return v;
}

/// Fixes all nodes at x = 0.
inline Constraints clamp_left(const Mesh& mesh) {
  Constraints constraints(mesh.num_nodes(), 3);
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    if (mesh.positions[3 * node] < 1e-9) constraints.fix(node);
  }
  return constraints;
}

}  // namespace elastogen::test
