// Orders of nodes and elements: that they are permutations, and bring neighbours together.
#include "runtime/mesh_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

MeshOrder random_order(const Mesh& mesh) {
  MeshOrder order;
  order.nodes.resize(mesh.num_nodes());
  order.elements.resize(mesh.num_elements());
  std::mt19937 generator(1);
  for (std::vector<std::int32_t>* numbers : {&order.nodes, &order.elements}) {
    std::iota(numbers->begin(), numbers->end(), 0);
    std::shuffle(numbers->begin(), numbers->end(), generator);
  }
  return order;
}

bool is_permutation_of_count(std::vector<std::int32_t> numbers, std::size_t count) {
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::int32_t> expected(count);
  std::iota(expected.begin(), expected.end(), 0);
  return numbers == expected;
}

/// Mean distance of the node numbers of consecutive elements.
double mean_jump(const Mesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 1; e < block.num_elements(); ++e, ++count) {
      sum += std::abs(block.element_nodes(e)[0] - block.element_nodes(e - 1)[0]);
    }
  }
  return sum / static_cast<double>(count);
}

Vector forces_on(const Mesh& mesh, const Vector& displacement) {
  const auto table = ReferenceKernels<Tet4, 8, false>::table();
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  Vector forces = Vector::Zero(displacement.size());
  model.forces(displacement, forces);
  return forces;
}

TEST(MeshOrder, AlongTheCurveBringsNeighboursTogetherAgain) {
  const Mesh natural = bar_mesh("tet4", {24, 6, 6}, {4, 1, 1});
  const Mesh random = reordered(natural, random_order(natural));
  const MeshOrder order = order_along_curve(random);
  ASSERT_TRUE(is_permutation_of_count(order.nodes, natural.num_nodes()));
  ASSERT_TRUE(is_permutation_of_count(order.elements, natural.num_elements()));
  EXPECT_LT(mean_jump(reordered(random, order)), 0.1 * mean_jump(random));
}

TEST(MeshOrder, ForcesAreThoseOfTheSameNodes) {
  const Mesh mesh = bar_mesh("tet4", {5, 3, 2}, {2, 1, 1});
  const MeshOrder order = order_along_curve(mesh);
  const Vector displacement =
      0.05 * Vector::Random(static_cast<Eigen::Index>(mesh.positions.size()));
  const Vector forces = forces_on(mesh, displacement);
  const Vector moved = forces_on(reordered(mesh, order), to_order(order, displacement));
  EXPECT_EQ(from_order(order, to_order(order, displacement)), displacement);
  EXPECT_LT((from_order(order, moved) - forces).norm(), 1e-12 * forces.norm());
}

TEST(MeshOrder, NodesOfNoElementComeLast) {
  Mesh mesh = bar_mesh("tet4", {2, 2, 2}, {1, 1, 1});
  mesh.positions.insert(mesh.positions.begin(), {9.0, 9.0, 9.0});
  for (std::int32_t& node : mesh.blocks[0].nodes) ++node;
  const MeshOrder order = order_along_curve(mesh);
  EXPECT_EQ(order.nodes.back(), 0);
  EXPECT_EQ(reordered(mesh, order).positions.back(), 9.0);
}

TEST(MeshOrder, BlocksKeepTheirElementsAndRegions) {
  Mesh mesh = bar_mesh("hexa8", {4, 2, 2}, {2, 1, 1});
  Mesh other = bar_mesh("tet4", {4, 2, 2}, {2, 1, 1});
  mesh.blocks.push_back(other.blocks[0]);
  mesh.region_names = {"first", "second"};
  for (std::size_t e = 0; e < mesh.blocks[1].num_elements(); ++e) {
    mesh.blocks[1].region[e] = static_cast<std::int32_t>(e % 2);
  }
  const MeshOrder order = order_along_curve(mesh);
  const Mesh result = reordered(mesh, order);
  ASSERT_EQ(result.blocks.size(), 2U);
  const std::size_t first = mesh.blocks[0].num_elements();
  for (std::size_t e = 0; e < result.blocks[1].num_elements(); ++e) {
    const auto old = static_cast<std::size_t>(order.elements[first + e]) - first;
    EXPECT_EQ(result.blocks[1].region[e], mesh.blocks[1].region[old]);
    EXPECT_EQ(order.nodes[static_cast<std::size_t>(result.blocks[1].element_nodes(e)[2])],
              mesh.blocks[1].element_nodes(old)[2]);
  }
}

}  // namespace
}  // namespace elastogen::test
