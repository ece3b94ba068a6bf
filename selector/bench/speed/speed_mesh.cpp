#include "selector/bench/speed/speed_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "selector/scene/bar_mesh.h"
#include "selector/scene/cube_cuts.h"

namespace elastogen::selector {
namespace {

constexpr double length = 8;  // of the beam; its width and height are 1

/// Moves nodes by up to a tenth of a cell, those of the surface along it.
void distort(Mesh& mesh, double cell) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> number(-0.1 * cell, 0.1 * cell);
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const double end = k % dim == 0 ? length : 1;
    double& x = mesh.positions[k];
    const double move = number(generator);
    if (x > 1e-9 && x < end - 1e-9) x += move;
  }
}

}  // namespace

Mesh make_speed_mesh(const symgen::AssociationId& association, std::size_t elements,
                     bool distorted) {
  const int dim = symgen::find_element(association.element).dim;
  const double per_cell = static_cast<double>(cube_cut(association.element).elements.size());
  const double cells = static_cast<double>(elements) / per_cell / length;
  const int n = std::max(1, static_cast<int>(std::lround(std::pow(cells, 1.0 / dim))));
  // The length takes up what rounding the sides has lost.
  const double section = std::pow(n, dim - 1);
  const int along = std::max(1, static_cast<int>(std::lround(cells * length / section)));
  BarDescription bar;
  bar.size = {length, 1, dim == 3 ? 1.0 : 0.0};
  bar.cells = {along, n, dim == 3 ? n : 0};
  SectionDescription whole;
  whole.association = association;
  whole.region = "beam";
  bar.sections.push_back(whole);
  Mesh mesh = make_bar(bar).mesh;
  if (distorted) distort(mesh, std::min(1.0 / n, length / along));
  return mesh;
}

Mesh shuffled(const Mesh& mesh) {
  std::mt19937 generator(3);
  const auto random_numbers = [&](std::size_t count) {
    std::vector<std::int32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    std::shuffle(numbers.begin(), numbers.end(), generator);
    return numbers;
  };
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const std::vector<std::int32_t> new_node = random_numbers(mesh.num_nodes());
  Mesh result = mesh;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    result.positions[dim * static_cast<std::size_t>(new_node[k / dim]) + k % dim] =
        mesh.positions[k];
  }
  ElementBlock& block = result.blocks.front();
  block.nodes.clear();
  for (const std::int32_t e : random_numbers(mesh.num_elements())) {
    for (const std::int32_t node : mesh.blocks.front().element_nodes(static_cast<std::size_t>(e))) {
      block.nodes.push_back(new_node[static_cast<std::size_t>(node)]);
    }
  }
  return result;
}

Vector bent(const Mesh& mesh) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  Vector u(static_cast<Eigen::Index>(mesh.positions.size()));
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const double x = mesh.positions[k / dim * dim];
    u[static_cast<Eigen::Index>(k)] =
        0.05 * std::sin(x + static_cast<double>(k % dim)) + 0.02 * mesh.positions[k];
  }
  return u;
}

Vector random_direction(const Mesh& mesh) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector v(static_cast<Eigen::Index>(mesh.positions.size()));
  for (double& value : v) value = number(generator);
  return v;
}

}  // namespace elastogen::selector
