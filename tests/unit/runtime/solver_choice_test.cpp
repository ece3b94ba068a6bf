// The choice of a linear solver.
#include "runtime/solver_choice.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

constexpr double much = 1e12;  // memory [bytes]

TEST(LayeredShape, SeesABarFromItsEnds) {
  const LayeredShape shape = layered_shape(bar_mesh("hexa8", {30, 3, 3}, {10, 1, 1}));
  EXPECT_EQ(shape.num_dofs, 31 * 16 * 3);
  EXPECT_EQ(shape.num_layers, 31);
  EXPECT_NEAR(shape.thickness, 4, 1e-12);
  const LayeredShape longer = layered_shape(bar_mesh("hexa8", {60, 3, 3}, {10, 1, 1}));
  // The ends, whose layers are narrower, count less in the longer one.
  EXPECT_NEAR(longer.multiplications / shape.multiplications, 61.0 / 31, 0.2);
}

TEST(ChooseLinearSolver, FactorizesSlenderBodiesAndIteratesOnThickOnes) {
  const Mesh slender = bar_mesh("hexa8", {100, 2, 2}, {100, 1, 1});
  const SolverChoice factor = choose_linear_solver(slender, SolverTask::equilibrium, much);
  EXPECT_NE(factor.kind, LinearSolverKind::conjugate_gradient);
  EXPECT_NE(factor.reason.find("costs less"), std::string::npos) << factor.reason;

  const Mesh thick = bar_mesh("hexa8", {30, 30, 30}, {1, 1, 1});
  const SolverChoice iterate = choose_linear_solver(thick, SolverTask::equilibrium, much);
  EXPECT_EQ(iterate.kind, LinearSolverKind::conjugate_gradient);
  EXPECT_GT(iterate.fall_back_after, 100);
  EXPECT_NE(iterate.reason.find("thick"), std::string::npos) << iterate.reason;
}

TEST(ChooseLinearSolver, NeverTakesAFactorThatDoesNotFit) {
  const Mesh slender = bar_mesh("hexa8", {100, 2, 2}, {100, 1, 1});
  for (const SolverTask task : {SolverTask::equilibrium, SolverTask::implicit_step}) {
    const SolverChoice choice = choose_linear_solver(slender, task, 1e4);
    EXPECT_EQ(choice.kind, LinearSolverKind::conjugate_gradient);
    EXPECT_EQ(choice.fall_back_after, 0);
    EXPECT_FALSE(choice.factorize_for_stability);
    EXPECT_NE(choice.reason.find("memory"), std::string::npos) << choice.reason;
  }
}

TEST(ChooseLinearSolver, DoesNotDependOnNodeNumbers) {
  Mesh mesh = bar_mesh("hexa8", {40, 4, 4}, {10, 1, 1});
  const SolverChoice choice = choose_linear_solver(mesh, SolverTask::equilibrium, much);
  const auto last = static_cast<std::int32_t>(mesh.num_nodes()) - 1;
  for (std::int32_t& node : mesh.blocks[0].nodes) node = last - node;
  const SolverChoice mirrored = choose_linear_solver(mesh, SolverTask::equilibrium, much);
  EXPECT_EQ(mirrored.kind, choice.kind);
  EXPECT_EQ(mirrored.reason, choice.reason);
}

}  // namespace
}  // namespace elastogen::test
