// Elements of one rest shape: how they are found, and that nothing else changes.
#include "runtime/congruent_elements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

/// Elements of two numbers each.
CongruentElements found_in(const std::vector<double>& shapes, std::size_t lanes) {
  std::vector<double> positions;
  for (const double shape : shapes) positions.insert(positions.end(), {0.0, shape});
  return find_congruent_elements(positions, 2, lanes);
}

TEST(CongruentElements, FillBatchesOfOneShapeEach) {
  std::vector<double> shapes;
  for (int k = 0; k < 1000; ++k) shapes.push_back(k % 3 == 0 ? 1.0 : 2.0 + k * 1e-15);
  const CongruentElements found = found_in(shapes, 8);
  std::multiset<std::size_t> all(found.order.begin(), found.order.end());
  all.insert(found.others.begin(), found.others.end());
  ASSERT_EQ(all.size(), 1000U);
  EXPECT_EQ(std::set<std::size_t>(all.begin(), all.end()).size(), 1000U);
  ASSERT_EQ(found.order.size(), 8 * found.shape.size());
  EXPECT_LT(found.others.size(), 16U);
  for (std::size_t k = 0; k < found.order.size(); ++k) {
    const std::size_t first = found.order[k / 8 * 8];
    EXPECT_EQ(found.order[k] % 3 == 0, first % 3 == 0) << k;
  }
  EXPECT_EQ(std::set<std::int32_t>(found.shape.begin(), found.shape.end()),
            (std::set<std::int32_t>{0, 1}));
}

TEST(CongruentElements, ShapesThatDifferByMoreThanRoundingAreNotShared) {
  std::vector<double> shapes;
  for (int k = 0; k < 1000; ++k) shapes.push_back(1 + k * 1e-9);
  const CongruentElements found = found_in(shapes, 8);
  EXPECT_TRUE(found.order.empty());
  EXPECT_EQ(found.others.size(), 1000U);
}

TEST(CongruentElements, AMinorityIsLeftWithTheOthers) {
  std::vector<double> shapes;
  for (int k = 0; k < 1000; ++k) shapes.push_back(k % 4 == 0 ? 1.0 : 2.0 + k * 1e-6);
  EXPECT_TRUE(found_in(shapes, 8).order.empty());
}

template <class Element>
void expect_same_results(const std::string& element, bool from_positions) {
  const auto stored = ReferenceKernels<Element, 8, false>::table();
  const auto recomputed = ReferenceKernels<Element, 8, true>::table();
  const auto& table = from_positions ? recomputed : stored;
  // Far from the origin, so that equal cells differ in their last digits.
  Mesh mesh = bar_mesh(element, {40, 3, 3}, {40.0 / 7, 1, 1});
  for (double& x : mesh.positions) x += 100;
  Model apart(mesh, one_part(mesh, table), {.threads = 1, .share_constants = false});
  ASSERT_EQ(apart.groups().size(), 1U);
  EXPECT_EQ(apart.groups()[0].num_shapes, mesh.num_elements());
  for (const int threads : {1, 2}) {
    Model shared(mesh, one_part(mesh, table), {.threads = threads});
    EXPECT_LE(shared.groups()[0].num_shapes, 6U);
    EXPECT_LT(shared.groups()[0].bytes_per_element, apart.groups()[0].bytes_per_element / 3);
    const Vector u = random_vector(shared.num_dofs(), 0.02, 5);
    const Vector v = random_vector(shared.num_dofs(), 1, 6);
    EXPECT_NEAR(shared.energy(u), apart.energy(u), 1e-11 * apart.energy(u));
    Vector here = Vector::Zero(u.size()), there = here;
    shared.forces(u, here);
    apart.forces(u, there);
    EXPECT_LT((here - there).norm(), 1e-11 * there.norm());
    shared.linearize(u);
    apart.linearize(u);
    here.setZero();
    there.setZero();
    shared.product(v, 0.5, here);
    apart.product(v, 0.5, there);
    EXPECT_LT((here - there).norm(), 1e-11 * there.norm());
    Eigen::SparseMatrix<double> a, b;
    shared.assemble(a);
    apart.assemble(b);
    EXPECT_LT((a - b).norm(), 1e-11 * b.norm());
    EXPECT_EQ(std::vector<double>(shared.nodal_mass().begin(), shared.nodal_mass().end()).size(),
              mesh.num_nodes());
    for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
      EXPECT_NEAR(shared.nodal_volumes()[n], apart.nodal_volumes()[n],
                  1e-11 * apart.nodal_volumes()[n]);
    }
  }
}

TEST(CongruentElements, GiveTheResultsOfElementsWithConstantsOfTheirOwn) {
  expect_same_results<Tet4>("tet4", false);
  expect_same_results<Hexa8>("hexa8", false);
}

TEST(CongruentElements, SharePositionsWhereKernelsReadThem) {
  expect_same_results<Hexa8>("hexa8", true);
}

// The bad element is found in whatever batch it stands.
TEST(CongruentElements, NameTheFirstBadElement) {
  const auto table = ReferenceKernels<Hexa8, 8, false>::table();
  const Mesh mesh = bar_mesh("hexa8", {40, 3, 3}, {40, 3, 3});
  Model model(mesh, one_part(mesh, table), {.threads = 2});
  Vector u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  // Turns one inner node through its neighbours.
  const std::int32_t node = mesh.blocks[0].element_nodes(200)[6];
  u[3 * node] = -30;
  Vector f = Vector::Zero(u.size());
  model.forces(u, f);
  EXPECT_FALSE(model.status().ok());
  std::size_t first = mesh.num_elements();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const auto nodes = mesh.blocks[0].element_nodes(e);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) first = std::min(first, e);
  }
  EXPECT_GE(model.status().element, first);
  EXPECT_LE(model.status().element, 200U);
}

}  // namespace
}  // namespace elastogen::test
