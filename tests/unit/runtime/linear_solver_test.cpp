// What linear solvers keep from one tangent to the next, and the order that they eliminate nodes
// in.
#include "runtime/linear_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "runtime/elimination_order.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

// A factor of the body at rest is no help for one that is bent far: iterations rise, and it is
// renewed; told to forget, at once.
TEST(LinearSolvers, RenewTheEarlierFactorWhenItServesNoMore) {
  const Mesh mesh = bar_mesh("hexa8", {8, 2, 2}, {8, 1, 1});
  const auto table = ReferenceKernels<Hexa8, 8, false>::table();
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  const Constraints constraints = clamp_left(mesh);
  const auto solver =
      make_linear_solver({.kind = LinearSolverKind::cholesky_cg}, model, constraints);
  const Vector b = random_vector(model.num_dofs(), 1, 3);
  Vector x = Vector::Zero(b.size());
  const auto iterations_at = [&](const Vector& u) {
    model.linearize(u);
    solver->update();
    EXPECT_TRUE(solver->set_shift(0));
    x.setZero();
    const LinearSolveReport report = solver->solve(b, 1e-8, x);
    EXPECT_TRUE(report.converged);
    return report.iterations;
  };
  const Vector rest = Vector::Zero(b.size());
  EXPECT_LE(iterations_at(rest), 2);
  Vector stretched = rest;  // twice as long, and turned by a right angle
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    const double x0 = mesh.positions[3 * a], y0 = mesh.positions[3 * a + 1];
    const auto dof = static_cast<Eigen::Index>(3 * a);
    stretched[dof] = -y0 - x0;
    stretched[dof + 1] = 2 * x0 - y0;
  }
  EXPECT_GT(iterations_at(stretched), 20);
  EXPECT_EQ(solver->factorizations(), 1);
  EXPECT_LE(iterations_at(stretched), 2);
  EXPECT_EQ(solver->factorizations(), 2);
  (void)iterations_at(stretched);
  EXPECT_EQ(solver->factorizations(), 2);
  solver->forget();
  (void)iterations_at(stretched);
  EXPECT_EQ(solver->factorizations(), 3);
}

// A long bar numbered section by section is best left alone, a cube is not.
TEST(EliminationOrder, TakesTheCheaperOfTheOwnOrderAndMinimumDegree) {
  const auto table = ReferenceKernels<Hexa8, 8, false>::table();
  const auto order_of = [&](const std::array<int, 3>& cells) {
    const Mesh mesh = bar_mesh("hexa8", cells, {8, 1, 1});
    Model model(mesh, one_part(mesh, table), {.threads = 1});
    Eigen::SparseMatrix<double> stiffness;
    model.assemble(stiffness);
    return elimination_order(stiffness, 3);
  };
  for (const std::array<int, 3>& cells : {std::array{40, 1, 1}, std::array{6, 6, 6}}) {
    std::vector<std::int32_t> order = order_of(cells);
    const bool is_own = std::is_sorted(order.begin(), order.end());
    EXPECT_EQ(is_own, cells[1] == 1);
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) {
      ASSERT_EQ(order[k], static_cast<std::int32_t>(k));
    }
  }
}

TEST(LinearSolvers, AGoodGuessSavesIterationsAndABadOneDoesNoHarm) {
  const Mesh mesh = bar_mesh("hexa8", {8, 2, 2}, {8, 1, 1});
  const auto table = ReferenceKernels<Hexa8, 8, false>::table();
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  const Constraints constraints = clamp_left(mesh);
  const auto solver = make_linear_solver({}, model, constraints);
  solver->update();
  ASSERT_TRUE(solver->set_shift(0));
  const Vector b = random_vector(model.num_dofs(), 1, 3);
  Vector from_zero = Vector::Zero(b.size());
  const int iterations = solver->solve(b, 1e-10, from_zero).iterations;

  Vector near = from_zero + 1e-6 * from_zero.norm() * random_vector(model.num_dofs(), 1, 4);
  EXPECT_LT(solver->solve(b, 1e-6, near).iterations, iterations);
  Vector exact = from_zero;
  EXPECT_EQ(solver->solve(b, 1e-8, exact).iterations, 0);
  EXPECT_EQ((exact - from_zero).norm(), 0);

  const double inf = std::numeric_limits<double>::infinity();
  for (const double size : {1e12, inf, inf - inf}) {
    Vector far = Vector::Constant(b.size(), size);
    const LinearSolveReport report = solver->solve(b, 1e-10, far);
    EXPECT_TRUE(report.converged) << size;
    EXPECT_EQ(report.iterations, iterations) << size;
    EXPECT_EQ((far - from_zero).norm(), 0) << size;
  }
}

}  // namespace
}  // namespace elastogen::test
