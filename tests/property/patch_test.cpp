// The patch test: where the boundary moves linearly, so does the inside, on distorted elements of
// every shape that meet conformingly (pyramids between prisms and hexahedra).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bars.h"
#include "runtime/newton.h"

namespace elastogen::test {
namespace {

constexpr std::array<double, 3> size{4.0, 1.0, 1.0};

bool is_on_boundary(const Mesh& mesh, std::size_t node) {
  for (int i = 0; i < 3; ++i) {
    const double x = mesh.positions[3 * node + i];
    if (std::abs(x) < 1e-12 || std::abs(x - size[i]) < 1e-12) return true;
  }
  return false;
}

void expect_patch_test(const std::vector<std::string>& associations) {
  Mesh mesh = make_bar_mesh(size, {8, 3, 3}, associations);
  std::vector<bool> boundary;
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) boundary.push_back(is_on_boundary(mesh, a));
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shift(-0.04, 0.04);
  std::size_t num_inside = 0;
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    if (boundary[a]) continue;
    ++num_inside;
    for (int i = 0; i < 3; ++i) mesh.positions[3 * a + i] += shift(generator);
  }
  ASSERT_GT(num_inside, 20U);

  const double gradient[3][3] = {{0.05, 0.02, -0.01}, {0.03, -0.04, 0.02}, {-0.02, 0.01, 0.03}};
  Vector expected(static_cast<Eigen::Index>(mesh.positions.size()));
  Constraints constraints(mesh.num_nodes(), 3);
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    for (int i = 0; i < 3; ++i) {
      double value = 0;
      for (int j = 0; j < 3; ++j) value += gradient[i][j] * mesh.positions[3 * a + j];
      expected[static_cast<Eigen::Index>(3 * a) + i] = value;
      if (boundary[a]) constraints.prescribe(a, i, value);
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

TEST(PatchTest, Tetrahedra) { expect_patch_test({"stvk-tet4-q1-none", "stvk-tet4-q4-none"}); }

TEST(PatchTest, HookeOnEveryConformingShape) {
  expect_patch_test({"hooke-prism6-q6-none", "hooke-hexa8-q8-none", "hooke-pyramid5-q5-none",
                     "hooke-hexa8-q27-none"});
}

}  // namespace
}  // namespace elastogen::test
