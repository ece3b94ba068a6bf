// Vector operations, linear solvers, static Newton.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/loads.h"
#include "runtime/newton.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

TEST(VectorOperations, DoNotDependOnThreads) {
  const Vector x = random_vector(100003, 1, 1);
  const Vector y = random_vector(100003, 1, 2);
  EXPECT_NEAR(dot(x, y, 1), x.dot(y), 1e-9);
  EXPECT_EQ(dot(x, y, 1), dot(x, y, 3));
  EXPECT_NEAR(norm(x, 2), x.norm(), 1e-10);
  Vector z = y;
  axpy(2, x, z, 3);
  EXPECT_LT((z - (y + 2 * x)).norm(), 1e-12);
  z = y;
  xpby(x, -3, z, 3);
  EXPECT_LT((z - (x - 3 * y)).norm(), 1e-12);
}

// A slender bar, clamped at x = 0.
class Cantilever : public testing::TestWithParam<LinearSolverKind> {
 protected:
  Cantilever()
      : mesh_(bar_mesh("hexa8", {8, 2, 2}, {8, 1, 1})),
        table_(ReferenceKernels<Hexa8, 8, false>::table()),
        model_(mesh_, one_part(mesh_, table_), {.threads = 1}),
        constraints_(clamp_left(mesh_)),
        load_(Vector::Zero(static_cast<Eigen::Index>(model_.num_dofs()))),
        u_(load_) {
    add_gravity(model_, std::array{0.0, 0.0, -0.05}, load_);
    options_.linear_solver.kind = GetParam();
  }
  [[nodiscard]] Eigen::Index tip() const { return u_.size() - 1; }
  NewtonResult solve() { return solve_static(model_, constraints_, load_, options_, u_); }

  Mesh mesh_;
  KernelTable<double> table_;
  Model model_;
  Constraints constraints_;
  Vector load_, u_;
  NewtonOptions options_;
};

TEST_P(Cantilever, LinearSolverSolvesOnTheFreeDegreesOfFreedom) {
  const auto solver = make_linear_solver({.kind = GetParam()}, model_, constraints_);
  model_.linearize(random_vector(model_.num_dofs(), 1e-3, 3));
  solver->update();
  Vector b = random_vector(model_.num_dofs(), 1, 4);
  Vector x = Vector::Zero(b.size());
  for (const double shift : {0.0, 0.5}) {
    ASSERT_TRUE(solver->set_shift(shift));
    const LinearSolveReport report = solver->solve(b, 1e-10, x);
    EXPECT_TRUE(report.converged);
    EXPECT_TRUE(report.positive_definite);
    Vector residual = b;
    model_.product(x, 1, residual);
    residual -= shift * shift_scale(solver->diagonal()).cwiseProduct(x);
    constraints_.project(residual);
    EXPECT_LT(residual.norm(), 1e-9 * b.norm());
    constraints_.project_constrained(x);
    EXPECT_EQ(x.norm(), 0.0);
  }
}

TEST_P(Cantilever, NegativeCurvatureIsSeenAndShiftedAway) {
  // Strong uniform compression along x: the tangent has negative directions.
  Vector u = Vector::Zero(u_.size());
  for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
    u[static_cast<Eigen::Index>(3 * node)] = -0.45 * mesh_.positions[3 * node];
  }
  const auto solver = make_linear_solver({.kind = GetParam()}, model_, constraints_);
  model_.linearize(u);
  solver->update();
  Vector x = Vector::Zero(u.size());
  const Vector b = random_vector(model_.num_dofs(), 1, 5);
  EXPECT_FALSE(solver->set_shift(0) && solver->solve(b, 1e-8, x).positive_definite);
  ASSERT_TRUE(solver->set_shift(10));
  EXPECT_TRUE(solver->solve(b, 1e-8, x).converged);
}

TEST_P(Cantilever, BalancesTheLoad) {
  const NewtonResult result = solve();
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_LT(u_[tip()], -0.5);
  EXPECT_LE(result.relative_residual, 2 * options_.tolerance);
  EXPECT_EQ(result.load_factor, 1.0);
  EXPECT_LE(result.iterations, 25);
  // The supports carry the whole weight and nothing else.
  Vector3 reaction = Vector3::Zero();
  for (Eigen::Index k = 0; k < u_.size(); ++k) reaction[k % 3] += result.reactions[k];
  EXPECT_NEAR(reaction[0], 0, 1e-4);
  EXPECT_NEAR(reaction[1], 0, 1e-4);
  EXPECT_NEAR(reaction[2], 8 * 1000 * 0.05, 1e-4);
  EXPECT_NEAR(result.energy, model_.energy(u_), 1e-12 * result.energy);
  EXPECT_NEAR(result.potential, result.energy - load_.dot(u_), 1e-10 * result.energy);
}

TEST_P(Cantilever, EnergyFallsAtEveryIteration) {
  std::vector<double> potentials;
  options_.on_iteration = [&](const NewtonProgress& progress) {
    EXPECT_EQ(progress.iteration, static_cast<int>(potentials.size()));
    potentials.push_back(progress.potential);
    return true;
  };
  const NewtonResult result = solve();
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  ASSERT_GE(potentials.size(), 4u);
  const double noise = 1e-12 * std::abs(potentials.back());
  for (std::size_t k = 1; k < potentials.size(); ++k) {
    EXPECT_LE(potentials[k], potentials[k - 1] + noise) << k;
  }
}

TEST_P(Cantilever, ACrushedStartNeedsTheShiftOrAProjection) {
  // Start from a state where the tangent is indefinite; the minimum is the same.
  const NewtonResult direct = solve();
  ASSERT_EQ(direct.status, NewtonStatus::converged) << direct.reason;
  const double tip_from_rest = u_[tip()];
  Vector start = random_vector(model_.num_dofs(), 0.02, 8);
  for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
    start[static_cast<Eigen::Index>(3 * node)] -= 0.2 * mesh_.positions[3 * node];
  }
  constraints_.impose(start);
  for (const TangentProjection projection :
       {TangentProjection::never, TangentProjection::on_demand, TangentProjection::always}) {
    SCOPED_TRACE(projection_name(projection));
    double largest_shift = 0;
    int projected = 0;
    options_.projection = projection;
    options_.on_iteration = [&](const NewtonProgress& progress) {
      largest_shift = std::max(largest_shift, progress.shift);
      projected += progress.projected ? 1 : 0;
      return true;
    };
    u_ = start;
    const NewtonResult result = solve();
    ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
    EXPECT_NEAR(u_[tip()], tip_from_rest, 1e-4 * std::abs(tip_from_rest));
    EXPECT_EQ(result.projections, projected);
    if (projection == TangentProjection::never) {
      EXPECT_GT(largest_shift, 0);
      EXPECT_EQ(projected, 0);
    } else {
      EXPECT_EQ(largest_shift, 0);
      EXPECT_GT(projected, 0);
      EXPECT_EQ(projected == result.iterations, projection == TangentProjection::always);
    }
  }
}

TEST_P(Cantilever, PrescribedStretchMatchesItsReactions) {
  load_.setZero();
  // Uniaxial stretch with free sides: S = E_young * E_xx, P = (1 + e) S on an area of 1 m^2.
  const double stretch = 0.05;
  constraints_ = Constraints(mesh_.num_nodes(), 3);
  for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
    const double* x = mesh_.positions.data() + 3 * node;
    if (x[0] < 1e-9) constraints_.fix(node, 0);
    if (x[0] > 8 - 1e-9) constraints_.prescribe(node, 0, 8 * stretch);
    if (x[1] < 1e-9) constraints_.fix(node, 1);
    if (x[2] < 1e-9) constraints_.fix(node, 2);
  }
  const NewtonResult result = solve();
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  const double strain = stretch + stretch * stretch / 2;
  const double expected = (1 + stretch) * 1e5 * strain;
  double left = 0;
  double right = 0;
  for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
    const double reaction = result.reactions[static_cast<Eigen::Index>(3 * node)];
    (mesh_.positions[3 * node] < 4 ? left : right) += reaction;
  }
  EXPECT_NEAR(right, expected, 1e-5 * expected);
  EXPECT_NEAR(left, -expected, 1e-5 * expected);
  EXPECT_NEAR(u_[tip() - 2], 8 * stretch, 1e-15);
}

TEST_P(Cantilever, StopsWhenAsked) {
  options_.on_iteration = [](const NewtonProgress& progress) { return progress.iteration < 2; };
  const NewtonResult result = solve();
  EXPECT_EQ(result.status, NewtonStatus::interrupted);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_TRUE(u_.allFinite());
  EXPECT_LT(u_[tip()], 0);
}

TEST_P(Cantilever, SaysWhenItDoesNotConverge) {
  options_.max_iterations = 2;
  const NewtonResult result = solve();
  EXPECT_EQ(result.status, NewtonStatus::not_converged);
  EXPECT_NE(result.reason.find("2 Newton iterations"), std::string::npos) << result.reason;
  EXPECT_EQ(result.load_factor, 0.0);
  EXPECT_LT(u_[tip()], 0);
}

TEST_P(Cantilever, ReachesTheRoundingLimitWithoutStalling) {
  options_.tolerance = 1e-16;
  const NewtonResult result = solve();
  EXPECT_EQ(result.status, NewtonStatus::converged_to_rounding) << result.reason;
  EXPECT_GT(result.relative_residual, 1e-16);
  EXPECT_LT(result.relative_residual, 1e-9);
}

TEST_P(Cantilever, NothingToDoTakesNoIteration) {
  load_.setZero();
  const NewtonResult result = solve();
  EXPECT_EQ(result.status, NewtonStatus::converged);
  EXPECT_EQ(result.iterations, 0);
}

TEST_P(Cantilever, ReleasedBodyReturnsToRest) {
  load_.setZero();
  u_ = random_vector(model_.num_dofs(), 0.05, 6);
  constraints_.impose(u_);
  const NewtonResult result = solve();
  EXPECT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_LT(u_.lpNorm<Eigen::Infinity>(), 1e-5);
}

TEST_P(Cantilever, RefusesBadCalls) {
  options_.tolerance = 0;
  EXPECT_THROW(static_cast<void>(solve()), InputError);
  options_.tolerance = 1e-8;
  constraints_ = Constraints(mesh_.num_nodes(), 3);
  try {
    static_cast<void>(solve());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing is fixed"), std::string::npos);
  }
  constraints_ = clamp_left(mesh_);
  u_ = random_vector(model_.num_dofs(), 3, 7);
  EXPECT_THROW(static_cast<void>(solve()), InputError);
}

INSTANTIATE_TEST_SUITE_P(, Cantilever,
                         testing::Values(LinearSolverKind::conjugate_gradient,
                                         LinearSolverKind::cholesky, LinearSolverKind::cholesky_cg,
                                         LinearSolverKind::incomplete_cg),
                         [](const testing::TestParamInfo<LinearSolverKind>& info) {
                           return std::string(solver_name(info.param));
                         });

TEST(SolveStatic, LinearSolversAgree) {
  const Mesh mesh = bar_mesh("tet4", {10, 2, 2}, {5, 1, 1});
  const auto table = ReferenceKernels<Tet4, 8, false>::table();
  Vector solutions[4];
  for (const auto kind : {LinearSolverKind::conjugate_gradient, LinearSolverKind::cholesky,
                          LinearSolverKind::cholesky_cg, LinearSolverKind::incomplete_cg}) {
    Model model(mesh, one_part(mesh, table), {.threads = 1});
    const Constraints constraints = clamp_left(mesh);
    Vector load = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
    add_gravity(model, std::array{0.0, 0.0, -1.0}, load);
    NewtonOptions options;
    options.linear_solver.kind = kind;
    options.tolerance = 1e-10;
    Vector& u = solutions[static_cast<int>(kind)];
    u = Vector::Zero(load.size());
    const NewtonResult result = solve_static(model, constraints, load, options, u);
    ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
    EXPECT_EQ(result.linear_iterations > 0, kind != LinearSolverKind::cholesky);
    EXPECT_EQ(result.factorizations > 0, kind != LinearSolverKind::conjugate_gradient);
    // A factor serves several tangents.
    if (kind == LinearSolverKind::cholesky_cg) {
      EXPECT_LT(2 * result.factorizations, result.iterations);
      EXPECT_LT(result.linear_iterations, 15 * result.iterations);
    }
  }
  EXPECT_LT((solutions[0] - solutions[1]).norm(), 1e-7 * solutions[1].norm());
  EXPECT_LT((solutions[2] - solutions[1]).norm(), 1e-7 * solutions[1].norm());
  EXPECT_LT((solutions[3] - solutions[1]).norm(), 1e-7 * solutions[1].norm());
}

// The reference kernels of one batch of hexa8, whose energy leaves its domain a given number of
// times once the body has been moved.
struct FailingKernels {
  using Reference = ReferenceKernels<Hexa8, 8, false>;
  static inline int failures_left = 0;

  static void energy(const KernelArguments<double>& args) {
    Reference::energy(args);
    bool moved = false;
    for (int k = 0; k < 24 * 8; ++k) moved = moved || args.displacement[k] != 0;
    if (!moved || failures_left == 0) return;
    --failures_left;
    args.status[0] |= status_outside_domain;
  }
};

TEST(SolveStatic, HalvesALoadStepWhosePrescribedMotionFails) {
  const Mesh mesh = bar_mesh("hexa8", {4, 1, 1}, {4, 1, 1});
  auto table = FailingKernels::Reference::table();
  VariantTable<double> variant = table.variants[0];
  variant.energy = each_batch<&FailingKernels::energy>;
  table.variants = &variant;
  Constraints constraints = clamp_left(mesh);
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    if (mesh.positions[3 * node] > 4 - 1e-9) constraints.prescribe(node, 2, 0.5);
  }
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  const Vector load = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  NewtonOptions options;
  options.tolerance = 1e-10;
  Vector direct = load;
  ASSERT_EQ(solve_static(model, constraints, load, options, direct).load_steps, 1);

  FailingKernels::failures_left = 2;
  Vector u = load;
  const NewtonResult result = solve_static(model, constraints, load, options, u);
  EXPECT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_EQ(result.load_steps, 4);  // halved twice
  EXPECT_LT((u - direct).norm(), 1e-7 * direct.norm());

  FailingKernels::failures_left = 2;
  options.max_halvings = 1;
  u = load;
  const NewtonResult given_up = solve_static(model, constraints, load, options, u);
  EXPECT_EQ(given_up.status, NewtonStatus::not_converged);
  EXPECT_NE(given_up.reason.find("prescribed motion is too large"), std::string::npos)
      << given_up.reason;
  EXPECT_EQ(given_up.load_factor, 0.0);

  FailingKernels::failures_left = 0;
  options.load_steps = 3;
  u = load;
  const NewtonResult in_steps = solve_static(model, constraints, load, options, u);
  EXPECT_EQ(in_steps.load_steps, 3);
  EXPECT_LT((u - direct).norm(), 1e-7 * direct.norm());
}

/// A bar whose end x = 4 turns about its axis by half a turn.
struct TwistedBar {
  TwistedBar()
      : mesh(bar_mesh("hexa8", {8, 2, 2}, {4, 1, 1})),
        model(mesh, one_part(mesh, table), {.threads = 1}),
        constraints(clamp_left(mesh)),
        motion(constraints),
        load(Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()))) {
    std::vector<std::int32_t> end;
    for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
      if (mesh.positions[3 * node] < 4 - 1e-9) continue;
      constraints.fix(node);
      end.push_back(static_cast<std::int32_t>(node));
    }
    motion = PrescribedMotion(constraints);
    motion.rotate(mesh, end, {{4, 0.5, 0.5}, {1, 0, 0}, std::numbers::pi}, History());
    options.load_steps = 6;
    options.tolerance = 1e-10;
  }
  [[nodiscard]] NewtonResult solve(LoadState& state) {
    return solve_static(model, constraints, motion, load, options, state);
  }

  KernelTable<double> table = ReferenceKernels<Hexa8, 8, false>::table();
  Mesh mesh;
  Model model;
  Constraints constraints;
  PrescribedMotion motion;
  Vector load;
  NewtonOptions options;
};

TEST(SolveStatic, TurnsAnEndOnACircleInLoadSteps) {
  TwistedBar bar;
  LoadState state;
  state.u = bar.load;
  std::vector<double> factors;
  bar.options.on_load_step = [&](const LoadState& at) { factors.push_back(at.load_factor); };
  const NewtonResult result = bar.solve(state);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  ASSERT_EQ(factors.size(), 6U);
  EXPECT_NEAR(factors[2], 0.5, 1e-15);
  EXPECT_EQ(state.load_factor, 1);
  for (std::size_t node = 0; node < bar.mesh.num_nodes(); ++node) {
    const double* at = &bar.mesh.positions[3 * node];
    if (at[0] < 4 - 1e-9) continue;
    const auto dof = static_cast<Eigen::Index>(3 * node);
    EXPECT_NEAR(state.u[dof], 0, 1e-14);
    EXPECT_NEAR(state.u[dof + 1], 1 - 2 * at[1], 1e-14);
    EXPECT_NEAR(state.u[dof + 2], 1 - 2 * at[2], 1e-14);
  }
}

TEST(SolveStatic, GoesOnFromALoadStepToTheSameBits) {
  TwistedBar bar;
  LoadState whole, part;
  whole.u = bar.load;
  bar.options.on_load_step = [&](const LoadState& at) {
    if (at.load_steps == 2) part = at;
  };
  ASSERT_EQ(bar.solve(whole).status, NewtonStatus::converged);
  TwistedBar again;
  const NewtonResult result = again.solve(part);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_EQ(result.load_steps, 6);
  EXPECT_EQ(result.iterations, whole.iterations);
  EXPECT_EQ((part.u - whole.u).norm(), 0.0);
  // From the end there is nothing left to do, and the forces are still reported.
  const NewtonResult ended = again.solve(part);
  EXPECT_EQ(ended.status, NewtonStatus::converged);
  EXPECT_EQ(ended.iterations, whole.iterations);
  EXPECT_LT((ended.reactions - result.reactions).norm(), 1e-12 * result.reactions.norm());
}

// The ordering of the factorisation depends on the numbers of the nodes, its result does not.
TEST(SolveStatic, CholeskyDoesNotDependOnNodeNumbers) {
  const auto table = ReferenceKernels<Hexa8, 8, false>::table();
  const Mesh mesh = bar_mesh("hexa8", {8, 2, 2}, {4, 1, 1});
  Mesh shuffled = mesh;
  std::vector<std::int32_t> number(mesh.num_nodes());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(8));
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    for (std::size_t i = 0; i < 3; ++i) {
      shuffled.positions[3 * static_cast<std::size_t>(number[node]) + i] =
          mesh.positions[3 * node + i];
    }
  }
  for (std::int32_t& node : shuffled.blocks[0].nodes) {
    node = number[static_cast<std::size_t>(node)];
  }
  std::vector<Vector> solutions;
  for (const Mesh* m : {&mesh, static_cast<const Mesh*>(&shuffled)}) {
    Model model(*m, one_part(*m, table), {.threads = 1});
    Vector load = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
    add_gravity(model, std::array{0.0, 0.0, -1.0}, load);
    Vector u = Vector::Zero(load.size());
    NewtonOptions options;
    options.linear_solver.kind = LinearSolverKind::cholesky;
    ASSERT_EQ(solve_static(model, clamp_left(*m), load, options, u).status,
              NewtonStatus::converged);
    solutions.push_back(u);
  }
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    const Vector3 a = solutions[0].segment<3>(static_cast<Eigen::Index>(3 * node));
    const Vector3 b = solutions[1].segment<3>(3 * number[node]);
    EXPECT_LT((a - b).norm(), 1e-9 * solutions[0].norm()) << node;
  }
}

}  // namespace
}  // namespace elastogen::test
