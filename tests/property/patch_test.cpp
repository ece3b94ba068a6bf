// The patch test: where the boundary moves linearly, so does the inside, on distorted elements of
// every shape that meet conformingly (pyramids between prisms and hexahedra).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bars.h"
#include "runtime/newton.h"
#include "symgen/element/element.h"

namespace elastogen::test {
namespace {

constexpr std::array<double, 3> size{4.0, 1.0, 1.0};

bool is_on_boundary(const Mesh& mesh, std::size_t node) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t i = 0; i < dim; ++i) {
    const double x = mesh.positions[dim * node + i];
    if (std::abs(x) < 1e-12 || std::abs(x - size[i]) < 1e-12) return true;
  }
  return false;
}

/// Nodes in the middle of the edges of quadratic elements go back there.
void straighten(const ElementBlock& block, Mesh& mesh) {
  const symgen::Element& element = symgen::find_element(block.element);
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t e = 0; e < block.num_elements(); ++e) {
    const auto nodes = block.element_nodes(e);
    for (std::size_t k = 0; k < element.edges.size(); ++k) {
      const auto at = [&](std::size_t local, std::size_t i) -> double& {
        return mesh.positions[dim * static_cast<std::size_t>(nodes[local]) + i];
      };
      const auto [a, b] = element.edges[k];
      const std::size_t middle = nodes.size() - element.edges.size() + k;
      for (std::size_t i = 0; i < dim; ++i) at(middle, i) = (at(a, i) + at(b, i)) / 2;
    }
  }
}

void expect_patch_test(const std::vector<std::string>& associations,
                       const std::array<int, 3>& cells = {8, 3, 3}) {
  Mesh mesh = make_bar_mesh(size, cells, associations);
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::vector<bool> boundary;
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) boundary.push_back(is_on_boundary(mesh, a));
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shift(-0.04, 0.04);
  std::size_t num_inside = 0;
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    if (boundary[a]) continue;
    ++num_inside;
    for (std::size_t i = 0; i < dim; ++i) mesh.positions[dim * a + i] += shift(generator);
  }
  for (const ElementBlock& block : mesh.blocks) straighten(block, mesh);
  ASSERT_GT(num_inside, 20U);

  const double gradient[3][3] = {{0.05, 0.02, -0.01}, {0.03, -0.04, 0.02}, {-0.02, 0.01, 0.03}};
  Vector expected(static_cast<Eigen::Index>(mesh.positions.size()));
  Constraints constraints(mesh.num_nodes(), mesh.dim);
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    for (std::size_t i = 0; i < dim; ++i) {
      double value = 0;
      for (std::size_t j = 0; j < dim; ++j) value += gradient[i][j] * mesh.positions[dim * a + j];
      expected[static_cast<Eigen::Index>(dim * a + i)] = value;
      if (boundary[a]) constraints.prescribe(a, static_cast<int>(i), value);
    }
  }
  Model model(mesh, parts_of(mesh, associations, 1e6, 0.3, 0.0), ModelOptions{});
  Vector u = Vector::Zero(expected.size());
  NewtonOptions options;
  options.tolerance = 1e-12;
  const NewtonResult result =
      solve_static(model, constraints, Vector::Zero(expected.size()), options, u);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_LT((u - expected).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(PatchTest, PrismsPyramidsHexahedraWithStVK) {
  expect_patch_test({"stvk-prism6-q6-none", "stvk-pyramid5-q5-none", "stvk-hexa8-q8-none",
                     "stvk-pyramid5-q8-none"});
}

TEST(PatchTest, RicherRulesWithNeoHooke) {
  expect_patch_test({"neo_hookean-prism6-q21-none", "neo_hookean-pyramid5-q8-none",
                     "neo_hookean-hexa8-q27-none", "neo_hookean-prism6-q6-none"});
}

TEST(PatchTest, TrianglesAndQuadrilateralsInThePlane) {
  expect_patch_test(
      {"stvk-tri3-q1-none", "stvk-quad4-q4-none", "stvk-tri3-q3-none", "stvk-quad4-q9-none"},
      {16, 4, 0});
  expect_patch_test({"neo_hookean-quad4-q4-none", "neo_hookean-tri3-q1-none"}, {16, 4, 0});
}

TEST(PatchTest, Tetrahedra) { expect_patch_test({"stvk-tet4-q1-none", "stvk-tet4-q4-none"}); }

// Reduced rules integrate gradients exactly where edges are straight, on warped faces, too.
TEST(PatchTest, QuadraticTetrahedraAndHexahedra) {
  expect_patch_test({"stvk-tet10-q4-none"});
  expect_patch_test({"neo_hookean-tet10-q4-none"});
  expect_patch_test({"stvk-hexa20-q8-none"});
}

TEST(PatchTest, HookeOnEveryConformingShape) {
  expect_patch_test({"hooke-prism6-q6-none", "hooke-hexa8-q8-none", "hooke-pyramid5-q5-none",
                     "hooke-hexa8-q27-none"});
}

}  // namespace
}  // namespace elastogen::test
