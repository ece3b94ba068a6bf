// Newton's method on slender bodies: negative curvature, rounding, stability, fall-back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "runtime/loads.h"
#include "runtime/newton.h"
#include "runtime/stability.h"
#include "runtime/tangent_shift.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

TEST(TangentShift, GrowsFromNothingAndFollowsTheLowestEigenvalue) {
  TangentShift shift;
  EXPECT_EQ(shift.value(), 0);
  ASSERT_TRUE(shift.grow());
  const double first = shift.value();
  EXPECT_GT(first, 0);
  EXPECT_LT(first, 1e-9);  // a bar a thousand times as long as thick has eigenvalues of 1e-12
  ASSERT_TRUE(shift.grow());
  EXPECT_GT(shift.value(), 2 * first);
  while (shift.value() < 1e-3) ASSERT_TRUE(shift.grow());

  shift.note(-1e-6);
  ASSERT_TRUE(shift.refine());  // far more than needed: once more, with less
  EXPECT_GT(shift.value(), 1e-6);
  EXPECT_LT(shift.value(), 3e-6);
  EXPECT_FALSE(shift.refine());
  const double refined = shift.value();
  ASSERT_TRUE(shift.grow());  // the estimate was one from above
  EXPECT_GT(shift.value(), refined);

  shift.note(-2e-6);
  shift.take_next_tangent();  // begins with what the last one needed
  EXPECT_GT(shift.value(), 2e-6);
  EXPECT_LT(shift.value(), 6e-6);
  shift.note(1e-7);
  shift.take_next_tangent();
  EXPECT_EQ(shift.value(), 0);
  shift.restart();
  ASSERT_TRUE(shift.grow());
  EXPECT_EQ(shift.value(), first);
  int growths = 0;
  while (shift.grow()) ASSERT_LT(++growths, 100);
}

/// A column of 20 x 1 x 1 m, clamped at x = 0 and pressed along x at its other end.
struct Column {
  /// @param load  over Euler's critical one of a cantilever
  /// @param lateral  a part of the load along z
  Column(double load, double lateral) {
    const double stiffness = young / 12;
    const double force =
        load * std::numbers::pi * std::numbers::pi * stiffness / (4 * length * length);
    const std::size_t first = mesh.num_nodes() - 4;
    for (std::size_t node = first; node < mesh.num_nodes(); ++node) {
      add_nodal_force(node, std::array{-force / 4, 0.0, lateral * force / 4}, forces);
    }
    u = Vector::Zero(forces.size());
  }
  NewtonResult solve() { return solve_static(model, constraints, forces, options, u); }
  [[nodiscard]] double tip(int component) const { return u[u.size() - 3 + component]; }

  static constexpr double young = 1e5, length = 20;
  Mesh mesh = bar_mesh("hexa8", {20, 1, 1}, {length, 1, 1});
  KernelTable<double> table = ReferenceKernels<Hexa8, 8, false>::table();
  std::vector<ModelPart> parts = [this] {
    std::vector<ModelPart> made = one_part(mesh, table);
    made[0].parameters = {0, young / 2};  // Poisson's ratio 0: the beam's stiffness is E I
    return made;
  }();
  Model model{mesh, parts, {.threads = 1}};
  Constraints constraints = clamp_left(mesh);
  Vector forces = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  Vector u;
  NewtonOptions options;
};

class ByEachMethod : public testing::TestWithParam<LinearSolverKind> {};

TEST_P(ByEachMethod, AColumnBucklesInFewIterations) {
  // Fully integrated hexa8 as long as thick shear-lock: h^2 / (2 t^2) more bending stiffness.
  Column column(1.5 * 1.2, 1e-3);
  column.options.linear_solver.kind = GetParam();
  // A shift far above the bending stiffness would make this steepest descent, by thousands. Loose
  // solutions of conjugate gradient take more tangents than exact ones.
  const bool has_factor =
      GetParam() == LinearSolverKind::cholesky || GetParam() == LinearSolverKind::cholesky_cg;
  column.options.max_iterations = has_factor ? 100 : 300;
  const NewtonResult result = column.solve();
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_GT(std::abs(column.tip(2)), 5);
  EXPECT_LT(column.tip(0), -1);
  EXPECT_NEAR(column.tip(1), 0, 1e-3);
  EXPECT_NE(result.stability, Stability::unstable);
}

TEST_P(ByEachMethod, AStraightColumnBeyondEulersLoadIsUnstable) {
  Column column(1.5 * 1.2, 0);
  column.options.linear_solver.kind = GetParam();
  column.options.factorize_for_stability = true;
  const NewtonResult result = column.solve();
  ASSERT_TRUE(in_equilibrium(result.status)) << result.reason;
  ASSERT_NEAR(column.tip(2), 0, 1e-6);
  EXPECT_EQ(result.stability, Stability::unstable);
  EXPECT_EQ(result.negative_eigenvalues, 2);  // it may bend along y and along z

  Column below(0.8, 0);
  below.options = column.options;
  EXPECT_EQ(below.solve().stability, Stability::stable);
}

INSTANTIATE_TEST_SUITE_P(, ByEachMethod,
                         testing::Values(LinearSolverKind::conjugate_gradient,
                                         LinearSolverKind::cholesky, LinearSolverKind::cholesky_cg,
                                         LinearSolverKind::incomplete_cg),
                         [](const testing::TestParamInfo<LinearSolverKind>& info) {
                           return std::string(solver_name(info.param));
                         });

TEST(Stability, IsNotCheckedWithoutAFactorUnlessAskedFor) {
  Column column(0.8, 0);
  const NewtonResult result = column.solve();
  EXPECT_EQ(result.method, LinearSolverKind::conjugate_gradient);
  EXPECT_EQ(result.stability, Stability::not_checked);
  EXPECT_EQ(result.factorizations, 0);
}

TEST(Stability, IsNotProvedByAProbeThatDoesNotConverge) {
  const Mesh mesh = bar_mesh("hexa8", {6, 4, 4}, {6, 4, 4});
  const KernelTable<double> table = ReferenceKernels<Hexa8, 8, false>::table();
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  const Constraints constraints = clamp_left(mesh);
  model.linearize(Vector::Zero(static_cast<Eigen::Index>(model.num_dofs())));
  LinearSolverOptions options;
  options.kind = LinearSolverKind::incomplete_cg;
  for (const int most : {1, 1000}) {
    options.max_iterations = most;
    const auto solver = make_linear_solver(options, model, constraints);
    const StabilityReport report =
        check_stability(*solver, model, constraints, options.cholesky, false);
    EXPECT_EQ(report.stability, Stability::stable);
    EXPECT_EQ(report.factorizations, most == 1 ? 1 : 0);
  }
}

// A bar whose systems are so ill-conditioned that one solution leaves much of the residual.
TEST(SlenderBar, IteratesUntilTheResidualStopsFallingAndSaysSo) {
  const Mesh mesh = bar_mesh("hexa8", {100, 1, 1}, {1000, 1, 1});
  const auto table = ReferenceKernels<Hexa8, 8, false>::table();
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  const Constraints constraints = clamp_left(mesh);
  Vector load = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  for (std::size_t node = mesh.num_nodes() - 4; node < mesh.num_nodes(); ++node) {
    add_nodal_force(node, std::array{0.0, 0.0, -1e-9}, load);
  }
  std::vector<double> residuals;
  NewtonOptions options;
  options.linear_solver.kind = LinearSolverKind::cholesky;
  options.tolerance = 1e-15;
  options.on_iteration = [&](const NewtonProgress& progress) {
    residuals.push_back(progress.residual);
    return true;
  };
  Vector u = Vector::Zero(load.size());
  const NewtonResult result = solve_static(model, constraints, load, options, u);
  EXPECT_EQ(result.status, NewtonStatus::converged_to_rounding);
  EXPECT_GT(result.relative_residual, options.tolerance);
  // What it ends with is about the least that was met.
  EXPECT_LE(result.residual, 2 * *std::min_element(residuals.begin(), residuals.end()));
  double reaction = 0;
  for (Eigen::Index dof = 2; dof < u.size(); dof += 3) reaction += result.reactions[dof];
  EXPECT_NEAR(reaction, 4e-9, 1e-6 * 4e-9);

  // A tolerance that can be met is.
  options.tolerance = 10 * result.relative_residual;
  u.setZero();
  EXPECT_EQ(solve_static(model, constraints, load, options, u).status, NewtonStatus::converged);
}

TEST(FallBack, ReplacesAConjugateGradientThatGetsNowhere) {
  Column direct(1.5 * 1.2, 1e-3);
  direct.options.load_steps = 3;
  direct.options.tolerance = 1e-10;
  direct.options.linear_solver.kind = LinearSolverKind::cholesky;
  ASSERT_EQ(direct.solve().status, NewtonStatus::converged);

  Column column(1.5 * 1.2, 1e-3);
  column.options = direct.options;
  column.options.linear_solver.kind = LinearSolverKind::conjugate_gradient;
  column.options.linear_solver.fall_back_after = 20;
  LoadState first, whole;
  column.options.on_load_step = [&](const LoadState& state) {
    if (state.load_steps == 1) first = state;
  };
  whole.u = Vector::Zero(column.u.size());
  const auto motion = PrescribedMotion::growing(column.constraints);
  const auto solve = [&](LoadState& state) {
    return solve_static(column.model, column.constraints, motion, column.forces, column.options,
                        state);
  };
  const NewtonResult result = solve(whole);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_EQ(result.method, LinearSolverKind::cholesky_cg);
  EXPECT_GT(result.factorizations, 0);
  EXPECT_TRUE(whole.fell_back);
  EXPECT_LT((whole.u - direct.u).norm(), 1e-5 * direct.u.norm());

  // A run that goes on knows of it: the same bits.
  ASSERT_TRUE(first.fell_back);
  ASSERT_EQ(solve(first).status, NewtonStatus::converged);
  EXPECT_EQ((first.u - whole.u).norm(), 0.0);
}

TEST(SolveStatic, LimitsTheIterationsOfEachLoadStep) {
  Column column(1.5 * 1.2, 1e-3);
  column.options.linear_solver.kind = LinearSolverKind::cholesky;
  column.options.load_steps = 10;
  std::vector<int> totals;
  column.options.on_load_step = [&](const LoadState& state) { totals.push_back(state.iterations); };
  // The first load step has no iterations before it: as many as the longest one are enough.
  const NewtonResult free = column.solve();
  ASSERT_EQ(free.status, NewtonStatus::converged);
  int longest = totals[0];
  for (std::size_t k = 1; k < totals.size(); ++k) {
    longest = std::max(longest, totals[k] - totals[k - 1]);
  }
  ASSERT_LT(longest, free.iterations);
  column.options.max_iterations = longest;
  column.u.setZero();
  EXPECT_EQ(column.solve().status, NewtonStatus::converged);
  column.options.max_iterations = longest - 1;
  column.u.setZero();
  const NewtonResult stopped = column.solve();
  EXPECT_EQ(stopped.status, NewtonStatus::not_converged);
  EXPECT_NE(stopped.reason.find("per load step"), std::string::npos) << stopped.reason;
}

}  // namespace
}  // namespace elastogen::test
