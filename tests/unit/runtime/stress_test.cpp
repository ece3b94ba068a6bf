// Model::stress: what kernels say of each point, whatever order the model computes elements in.
#include "runtime/stress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/model.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

template <class Element>
typename Element::Nodes3 values_of_nodes(const Mesh& mesh, std::size_t e, const double* values) {
  typename Element::Nodes3 m;
  const auto nodes = mesh.blocks[0].element_nodes(e);
  for (int a = 0; a < Element::num_nodes; ++a) {
    m.col(a) = Eigen::Map<const Vector3>(values + 3 * nodes[static_cast<std::size_t>(a)]);
  }
  return m;
}

/// Displacement gradient and volume at a point, from the element's own nodes in their own order.
template <class Element>
PointStress expected_point(const Mesh& mesh, std::size_t e, int q, const Vector& u) {
  const Matrix3 j =
      values_of_nodes<Element>(mesh, e, mesh.positions.data()) * Element::gradients(q).transpose();
  const Matrix3 h =
      values_of_nodes<Element>(mesh, e, u.data()) * Element::gradients(q).transpose() * j.inverse();
  const Matrix3 strain = (h + h.transpose() + h.transpose() * h) / 2;
  const std::vector<double> lame = lame_parameters();
  const Matrix3 s = lame[0] * strain.trace() * Matrix3::Identity() + 2 * lame[1] * strain;
  const double energy = (s.cwiseProduct(strain)).sum() / 2;
  return {h, (Matrix3::Identity() + h) * s, energy, Element::weight(q) * j.determinant()};
}

/// Rounding of sums of some ten products.
constexpr double tolerance = 1e-13;

template <class Element>
void expect_points_of(const Mesh& mesh, Model& model, const Vector& u) {
  StressField field;
  model.stress(u, field);
  EXPECT_TRUE(model.status().ok());
  ASSERT_EQ(field.first.size(), mesh.num_elements() + 1);
  ASSERT_EQ(field.points.size(), mesh.num_elements() * Element::num_points);
  const double stiffness = lame_parameters()[0] + 2 * lame_parameters()[1];
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    ASSERT_EQ(field.first[e + 1] - field.first[e], Element::num_points);
    for (int q = 0; q < Element::num_points; ++q) {
      const PointStress& found = field.points[field.first[e] + static_cast<std::size_t>(q)];
      const PointStress expected = expected_point<Element>(mesh, e, q, u);
      EXPECT_LT((found.gradient - expected.gradient).norm(), tolerance) << e << " point " << q;
      EXPECT_LT((found.first_piola - expected.first_piola).norm(), tolerance * stiffness);
      EXPECT_NEAR(found.energy_density, expected.energy_density, tolerance * stiffness);
      EXPECT_NEAR(found.volume, expected.volume, tolerance * expected.volume);
    }
  }
}

template <class Element, int Lanes>
void expect_points_in_order(const ModelOptions& options, bool scattered) {
  const KernelTable<double> table = ReferenceKernels<Element, Lanes, false>::table();
  Mesh mesh = bar_mesh(Element::name, {5, 3, 3}, block_lengths);
  distort(mesh, block_lengths, 0.05, 1);
  if (scattered) {  // nodes at random, so that the model takes numbers of its own
    std::vector<std::int32_t> number(mesh.num_nodes());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), std::mt19937(2));
    const std::vector<double> before = mesh.positions;
    for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
      std::copy_n(&before[3 * node], 3,
                  &mesh.positions[3 * static_cast<std::size_t>(number[node])]);
    }
    for (std::int32_t& node : mesh.blocks[0].nodes) node = number[static_cast<std::size_t>(node)];
  }
  Model model(mesh, one_part(mesh, table), options);
  expect_points_of<Element>(mesh, model, random_vector(model.num_dofs(), 0.03, 3));
}

TEST(ModelStress, HasThePointsOfAllElementsInOrder) {
  expect_points_in_order<Tet4, 1>({.threads = 1}, false);
  expect_points_in_order<Tet4, 4>({.threads = 3}, false);
  expect_points_in_order<Hexa8, 8>({.threads = 2}, false);
}

TEST(ModelStress, HasThemWhereTheModelGoesAlongACurve) {
  // Sleeping makes any model do so.
  expect_points_in_order<Tet4, 4>({.threads = 2, .sleep = {.motion = 1e-3}}, true);
}

TEST(ModelStress, IsComputedBetweenHeldNodesToo) {
  const KernelTable<double> table = ReferenceKernels<Hexa8, 4, false>::table();
  const Mesh mesh = bar_mesh("hexa8", {4, 2, 2}, block_lengths);
  ModelOptions options{.threads = 2};
  for (std::int32_t node = 0; node < 18; ++node) options.held_nodes.push_back(node);
  Model model(mesh, one_part(mesh, table), options);
  ASSERT_EQ(model.skipped().elements_at_rest, 4u);
  Vector u = random_vector(model.num_dofs(), 0.03, 4);
  expect_points_of<Hexa8>(mesh, model, u);
}

// Boxes whose nodes begin at any corner, in any direction: kernels put them in one order, which
// moves the points, too.
TEST(ModelStress, KeepsTheOwnOrderOfTurnedBoxes) {
  const KernelTable<double> table = ReferenceKernels<Hexa8, 4, false>::table(true);
  Mesh mesh = bar_mesh("hexa8", {5, 3, 3}, block_lengths);
  constexpr std::array<int, 8> about_z = {1, 2, 3, 0, 5, 6, 7, 4};
  constexpr std::array<int, 8> about_x = {3, 2, 6, 7, 0, 1, 5, 4};
  std::mt19937 random(5);
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    std::int32_t* const nodes = &mesh.blocks[0].nodes[8 * e];
    for (int turns = static_cast<int>(random() % 6); turns > 0; --turns) {
      const auto& turn = random() % 2 == 0 ? about_z : about_x;
      std::array<std::int32_t, 8> before{};
      std::copy_n(nodes, 8, before.begin());
      for (std::size_t a = 0; a < 8; ++a) nodes[a] = before[static_cast<std::size_t>(turn[a])];
    }
  }
  for (const bool share_constants : {false, true}) {
    ModelOptions options{.threads = 1};
    options.share_constants = share_constants;
    Model model(mesh, one_part(mesh, table), options);
    ASSERT_EQ(model.groups().front().geometry, "box");
    expect_points_of<Hexa8>(mesh, model, random_vector(model.num_dofs(), 0.03, 6));
  }
}

TEST(ModelStress, TellsTheFirstElementOutsideItsLawsDomain) {
  const KernelTable<double> table = ReferenceKernels<Tet4, 4, false>::table();
  const Mesh mesh = bar_mesh("tet4", {3, 1, 1}, block_lengths);
  Model model(mesh, one_part(mesh, table), {.threads = 2});
  Vector u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  const std::int32_t node = mesh.blocks[0].element_nodes(7)[0];
  u[3 * node] = 5;  // beyond the neighbours
  Vector f = Vector::Zero(u.size());
  model.forces(u, f);
  const ElementStatus expected = model.status();
  ASSERT_EQ(expected.flags, status_outside_domain);
  StressField field;
  model.stress(u, field);
  EXPECT_EQ(model.status().flags, status_outside_domain);
  EXPECT_EQ(model.status().element, expected.element);
}

TEST(ModelStress, NeedsItsKernels) {
  KernelTable<double> table = ReferenceKernels<Tet4, 4, false>::table();
  VariantTable<double> variant = table.variants[0];
  variant.stress = nullptr;
  table.variants = &variant;
  const Mesh mesh = bar_mesh("tet4", {1, 1, 1}, block_lengths);
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  StressField field;
  EXPECT_THROW(model.stress(Vector::Zero(24), field), InternalError);
}

}  // namespace
}  // namespace elastogen::test
