// What models leave out: elements between held nodes, and regions that sleep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/model.h"
#include "runtime/prescribed_motion.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

constexpr std::array<double, 3> bar_lengths = {4, 1, 1};

std::vector<std::int32_t> nodes_up_to(const Mesh& mesh, double x) {
  std::vector<std::int32_t> nodes;
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    if (mesh.positions[3 * node] <= x) nodes.push_back(static_cast<std::int32_t>(node));
  }
  return nodes;
}

/// Random numbers, 0 at the held nodes.
Vector random_but_held(const Mesh& mesh, const std::vector<std::int32_t>& held, double size) {
  Vector u = size * Vector::Random(static_cast<Eigen::Index>(mesh.positions.size()));
  for (const std::int32_t node : held) u.segment<3>(3 * node).setZero();
  return u;
}

Vector forces_at(Model& model, const Vector& u) {
  Vector f = Vector::Zero(u.size());
  model.forces(u, f);
  EXPECT_TRUE(model.status().ok());
  return f;
}

class AtRest : public testing::TestWithParam<TangentProduct> {};

TEST_P(AtRest, ElementsBetweenHeldNodesAreMissedByNobody) {
  const Mesh mesh = bar_mesh("hexa8", {8, 4, 4}, bar_lengths);
  const auto table = ReferenceKernels<Hexa8, 4, false>::table();
  const std::vector<std::int32_t> held = nodes_up_to(mesh, 2.0);
  const ModelOptions options = {.threads = 2, .tangent_product = GetParam()};
  ModelOptions skipping = options;
  skipping.held_nodes = held;
  Model whole(mesh, one_part(mesh, table), options);
  Model model(mesh, one_part(mesh, table), skipping);

  const Vector u = random_but_held(mesh, held, 0.02), v = random_but_held(mesh, held, 1);
  const double bound = 1e-13;
  const Vector f = forces_at(whole, u);
  EXPECT_LT((forces_at(model, u) - f).norm(), bound * f.norm());
  EXPECT_NEAR(model.energy(u), whole.energy(u), bound * whole.energy(u));
  std::vector<double> energies, expected_energies;
  model.element_energies(u, energies);
  whole.element_energies(u, expected_energies);
  EXPECT_EQ(energies, expected_energies);

  // K differs by the rows of held nodes alone.
  model.linearize(u);
  whole.linearize(u);
  Vector p = Vector::Zero(u.size()), expected = Vector::Zero(u.size());
  model.product(v, 1, p);
  whole.product(v, 1, expected);
  EXPECT_LT((p - expected).norm(), bound * expected.norm());
  Eigen::SparseMatrix<double> k, expected_k;
  model.assemble(k);
  whole.assemble(expected_k);
  EXPECT_LT((Vector(k * v) - Vector(expected_k * v)).norm(), bound * expected.norm());

  const auto same = [](std::span<const double> a, std::span<const double> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return std::abs(x - y) <= 1e-14 * std::abs(y); });
  };
  EXPECT_TRUE(same(model.nodal_mass(), whole.nodal_mass()));
  EXPECT_TRUE(same(model.element_volumes(), whole.element_volumes()));
  EXPECT_EQ(model.skipped().elements_at_rest, 4U * 16);
  EXPECT_EQ(whole.skipped().elements_at_rest, 0U);
  std::size_t counted = 0;
  for (const GroupSummary& group : model.groups()) counted += group.num_elements;
  EXPECT_EQ(counted, mesh.num_elements());
}

INSTANTIATE_TEST_SUITE_P(SkippedWork, AtRest,
                         testing::Values(TangentProduct::recompute, TangentProduct::two_stage,
                                         TangentProduct::assembled),
                         [](const auto& test) {
                           return "strategy_" + std::to_string(static_cast<int>(test.param));
                         });

TEST(SkippedWork, HeldNodesAreThoseThatNeverMove) {
  const Mesh mesh = bar_mesh("hexa8", {4, 1, 1}, bar_lengths);
  Constraints constraints(mesh.num_nodes(), 3);
  for (const std::size_t node : {0U, 1U, 2U, 3U, 5U}) constraints.fix(node);
  constraints.fix(7, 1);
  constraints.prescribe(8, 0, 0.5);
  constraints.fix(8, 1);
  constraints.fix(8, 2);
  PrescribedMotion motion(constraints);
  motion.translate(2, 0, 0.1, History::sine(1));
  const std::vector<std::int32_t> turned = {3};
  motion.rotate(mesh, turned, {{0, 0, 0}, {1, 0, 0}, 0.5}, History());
  EXPECT_EQ(motion.held_nodes(), (std::vector<std::int32_t>{0, 1, 5}));
}

/// Greatest sum of a row's absolute values.
double largest_row(const Eigen::SparseMatrix<double>& k) {
  Vector sums = Vector::Zero(k.rows());
  for (Eigen::Index j = 0; j < k.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(k, j); it; ++it) {
      sums[it.row()] += std::abs(it.value());
    }
  }
  return sums.maxCoeff();
}

class Sleep : public testing::TestWithParam<int> {
 protected:
  Sleep() : mesh_(bar_mesh("tet4", {40, 8, 8}, bar_lengths)) {}

  [[nodiscard]] Model make(double motion, int calls) const {
    Model model(mesh_, one_part(mesh_, table_), {.threads = GetParam(), .sleep = {motion, calls}});
    model.let_sleep(true);
    return model;
  }
  /// A wave that has come as far as `front` along the bar.
  [[nodiscard]] Vector wave(double front) const {
    Vector u = Vector::Zero(static_cast<Eigen::Index>(mesh_.positions.size()));
    for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
      const double behind = front - mesh_.positions[3 * node];
      if (behind > 0) {
        u[static_cast<Eigen::Index>(3 * node + 2)] =
            0.05 * std::sin(3 * behind) * std::min(1.0, behind);
      }
    }
    return u;
  }

  KernelTable<double> table_ = ReferenceKernels<Tet4, 4, false>::table();
  Mesh mesh_;
};

TEST_P(Sleep, ForcesAreThoseOfADisplacementWithinTheMotionAllowed) {
  const double motion = 1e-4;
  Model sleeping = make(motion, 3), awake = make(0, 1);
  awake.linearize(wave(4));
  Eigen::SparseMatrix<double> k;
  awake.assemble(k);
  const double bound = 1.2 * motion * largest_row(k);  // K elsewhere is not much larger
  const auto num_nodes = static_cast<Eigen::Index>(mesh_.num_nodes());
  double farthest = 0;
  for (int step = 0; step < 60; ++step) {
    const Vector u = wave(0.05 * step) + 0.4 * motion * Vector::Random(3 * num_nodes);
    farthest =
        std::max(farthest, (forces_at(sleeping, u) - forces_at(awake, u)).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(farthest, bound);
  EXPECT_GT(farthest, 1e-3 * bound);
  const SkippedWork skipped = sleeping.skipped();
  EXPECT_EQ(skipped.element_passes, 60 * static_cast<std::int64_t>(mesh_.num_elements()));
  EXPECT_GT(skipped.slept, skipped.element_passes / 5);
  EXPECT_LT(skipped.slept, 4 * skipped.element_passes / 5);
}

TEST_P(Sleep, WakesWhereSomethingMovesAndNowhereElse) {
  const double motion = 1e-3;
  Model model = make(motion, 2);
  Model awake = make(0, 1);
  Vector u = wave(0);
  for (int step = 0; step < 4; ++step) (void)forces_at(model, u);
  const auto num_slept = [&] {
    const std::int64_t before = model.skipped().slept;
    (void)forces_at(model, u);
    return model.skipped().slept - before;
  };
  const auto all = static_cast<std::int64_t>(mesh_.num_elements());
  EXPECT_EQ(num_slept(), all);
  const Eigen::Index corner = u.size() - 3;
  u[corner] = 0.9 * motion;  // not far enough
  EXPECT_EQ(num_slept(), all);
  EXPECT_EQ(forces_at(model, u).norm(), 0);
  u[corner] = 1.1 * motion;
  const std::int64_t slept = num_slept();
  EXPECT_LT(slept, all);
  EXPECT_GT(slept, 3 * all / 4);
  const Vector f = forces_at(awake, u);
  EXPECT_LT((forces_at(model, u) - f).norm(), 1e-13 * f.norm());
}

TEST_P(Sleep, BeginsAndEndsWhenTold) {
  Model model(mesh_, one_part(mesh_, table_), {.threads = GetParam(), .sleep = {1e-3, 1}});
  const Vector u = wave(2);
  const auto slept_in_three = [&] {
    const std::int64_t before = model.skipped().slept;
    for (int step = 0; step < 3; ++step) (void)forces_at(model, u);
    return model.skipped().slept - before;
  };
  EXPECT_EQ(slept_in_three(), 0);
  model.let_sleep(true);
  EXPECT_GT(slept_in_three(), 0);
  model.let_sleep(false);
  EXPECT_EQ(slept_in_three(), 0);
}

TEST_P(Sleep, NotANumberWakesAndIsReported) {
  Model model = make(1e-3, 1);
  Vector u = wave(0);
  for (int step = 0; step < 3; ++step) (void)forces_at(model, u);
  u[300] = std::numeric_limits<double>::quiet_NaN();
  Vector f = Vector::Zero(u.size());
  model.forces(u, f);
  EXPECT_FALSE(model.status().ok());
}

INSTANTIATE_TEST_SUITE_P(SkippedWork, Sleep, testing::Values(1, 3));

}  // namespace
}  // namespace elastogen::test
