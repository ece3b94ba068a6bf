#include "selector/bench/calculix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../temporary_folder.h"
#include "beam_mesh.h"
#include "runtime/error.h"

namespace elastogen::selector {
namespace {

/// The cantilever of the thesis, section 6.3.4.
CalculixProblem cantilever(const Mesh& mesh, const std::string& type) {
  CalculixProblem problem;
  problem.mesh = &mesh;
  problem.element_type = type;
  problem.young = 100e6;
  problem.density = 1000;
  problem.gravity = {0, 0, -9.81};
  problem.large_deformation = true;
  problem.time_limit = 120;
  problem.prescribed.resize(1);
  for (const std::size_t node : section_nodes(mesh, 0)) {
    for (int c = 0; c < 3; ++c) problem.prescribed.front().push_back({node, c, 0});
  }
  return problem;
}

double mean_tip(const Mesh& mesh, const CalculixResult& result) {
  double sum = 0;
  const std::vector<std::size_t> tip = section_nodes(mesh, 8);
  for (const std::size_t node : tip) sum += result.displacement[3 * node + 2];
  return sum / static_cast<double>(tip.size());
}

struct Reference {
  const char* type;
  const char* element;
  std::array<int, 3> cells;
  double tip;  ///< mean u_z of the end face [m]
  double tolerance;
};

class CalculixCantilever : public testing::TestWithParam<Reference> {};

// C3D8, C3D4 and C3D10 must have the figures of FEniCSx 0.5 on the same meshes. The others have
// other points of integration than elements elsewhere: they must be near the converged deflection.
TEST_P(CalculixCantilever, HasTheKnownDeflection) {
  if (!have_calculix()) GTEST_SKIP() << "ccx is not installed";
  const TemporaryFolder folder;
  const Mesh mesh = beam_mesh(GetParam().element, GetParam().cells);
  const CalculixResult result =
      run_calculix(cantilever(mesh, GetParam().type), folder.path(), "beam");
  EXPECT_NEAR(mean_tip(mesh, result), GetParam().tip, GetParam().tolerance);
  EXPECT_EQ(result.solver, "spooles");
  EXPECT_GE(result.iterations, 2);
  EXPECT_GT(result.wall_seconds, 0);
  EXPECT_GT(result.cpu_seconds, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "beam.inp"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "beam.frd"));
}

INSTANTIATE_TEST_SUITE_P(Elements, CalculixCantilever,
                         testing::Values(Reference{"C3D4", "tet4", {48, 8, 8}, -0.567049, 2e-6},
                                         Reference{"C3D6", "prism6", {24, 4, 4}, -0.6076, 1e-2},
                                         Reference{"C3D8", "hexa8", {24, 4, 4}, -0.575799, 2e-6},
                                         Reference{"C3D8I", "hexa8", {24, 4, 4}, -0.6076, 1e-2},
                                         Reference{"C3D8R", "hexa8", {24, 4, 4}, -0.6076, 5e-2},
                                         Reference{"C3D10", "tet10", {24, 4, 4}, -0.607567, 2e-6},
                                         Reference{"C3D20", "hexa20", {24, 4, 4}, -0.6076, 5e-5},
                                         Reference{"C3D20R", "hexa20", {12, 2, 2}, -0.6076, 2e-4}),
                         [](const auto& info) { return std::string(info.param.type); });

TEST(Calculix, FollowsAPathOfSteps) {
  if (!have_calculix()) GTEST_SKIP() << "ccx is not installed";
  // A beam turned rigidly by 180 degrees about its axis: the straight way there would flatten it.
  const TemporaryFolder folder;
  const Mesh mesh = beam_mesh("hexa8", {4, 2, 2});
  CalculixProblem problem = cantilever(mesh, "C3D8");
  problem.gravity = {};
  problem.prescribed.clear();
  constexpr int num_steps = 4;
  for (int step = 1; step <= num_steps; ++step) {
    const double angle = std::numbers::pi * step / num_steps;
    std::vector<NodalValue>& values = problem.prescribed.emplace_back();
    for (const double x : {0., 8.}) {
      for (const std::size_t node : section_nodes(mesh, x)) {
        const double y = mesh.positions[3 * node + 1], z = mesh.positions[3 * node + 2];
        values.push_back({node, 0, 0});
        values.push_back({node, 1, std::cos(angle) * y - std::sin(angle) * z - y});
        values.push_back({node, 2, std::sin(angle) * y + std::cos(angle) * z - z});
      }
    }
  }
  const CalculixResult result = run_calculix(problem, folder.path(), "turn");
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    EXPECT_NEAR(result.displacement[3 * n], 0, 1e-4);
    EXPECT_NEAR(result.displacement[3 * n + 1], -2 * mesh.positions[3 * n + 1], 1e-4);
    EXPECT_NEAR(result.displacement[3 * n + 2], -2 * mesh.positions[3 * n + 2], 1e-4);
  }
}

TEST(Calculix, AppliesNodalForces) {
  if (!have_calculix()) GTEST_SKIP() << "ccx is not installed";
  const TemporaryFolder folder;
  const Mesh mesh = beam_mesh("hexa8", {4, 1, 1});
  CalculixProblem problem = cantilever(mesh, "C3D8");
  problem.gravity = {};
  problem.large_deformation = false;
  for (const std::size_t node : section_nodes(mesh, 8)) problem.forces.push_back({node, 0, 25e3});
  const CalculixResult result = run_calculix(problem, folder.path(), "pull");
  for (const std::size_t node : section_nodes(mesh, 8)) {  // F L / (E A)
    EXPECT_NEAR(result.displacement[3 * node], 100e3 * 8 / 100e6, 1e-8);
  }
  EXPECT_EQ(result.iterations, 1);
}

TEST(Calculix, HeedsToleranceIncrementsAndSolver) {
  if (!have_calculix()) GTEST_SKIP() << "ccx is not installed";
  const TemporaryFolder folder;
  const Mesh mesh = beam_mesh("hexa8", {12, 2, 2});
  CalculixProblem problem = cantilever(mesh, "C3D8");
  const CalculixResult usual = run_calculix(problem, folder.path(), "beam");
  problem.tolerance = 1e-9;
  const CalculixResult sharp = run_calculix(problem, folder.path(), "beam");
  EXPECT_GT(sharp.iterations, usual.iterations);
  problem.increments = 5;
  const CalculixResult slow = run_calculix(problem, folder.path(), "beam");
  EXPECT_GE(slow.iterations, sharp.iterations + 5);
  EXPECT_NEAR(mean_tip(mesh, slow), mean_tip(mesh, sharp), 1e-6);
  problem.equation_solver = "ITERATIVE CHOLESKY";
  const CalculixResult iterative = run_calculix(problem, folder.path(), "beam");
  EXPECT_EQ(iterative.solver, "iterative");
  EXPECT_NEAR(mean_tip(mesh, iterative), mean_tip(mesh, sharp), 1e-4);
}

TEST(Calculix, TellsWhyItFailed) {
  if (!have_calculix()) GTEST_SKIP() << "ccx is not installed";
  const TemporaryFolder folder;
  Mesh mesh = beam_mesh("hexa8", {2, 1, 1});
  std::swap(mesh.blocks[0].nodes[0], mesh.blocks[0].nodes[1]);
  const std::string message = message_of<WorkError>(
      [&] { (void)run_calculix(cantilever(mesh, "C3D8"), folder.path(), "bad"); });
  EXPECT_NE(message.find("bad.inp: CalculiX failed with status 201"), std::string::npos) << message;
  EXPECT_NE(message.find("acobian"), std::string::npos) << message;
}

TEST(Calculix, StopsWhenItsTimeIsOver) {
  if (!have_calculix()) GTEST_SKIP() << "ccx is not installed";
  const TemporaryFolder folder;
  const Mesh mesh = beam_mesh("hexa8", {48, 8, 8});
  CalculixProblem problem = cantilever(mesh, "C3D8");
  problem.time_limit = 0.1;
  const std::string message =
      message_of<WorkError>([&] { (void)run_calculix(problem, folder.path(), "slow"); });
  EXPECT_NE(message.find("stopped after 0.1 s"), std::string::npos) << message;
}

TEST(Calculix, IsMissedByName) {
  const TemporaryFolder folder;
  const EnvironmentVariable path("PATH", folder.path().string());
  const Mesh mesh = beam_mesh("hexa8", {1, 1, 1});
  const std::string message = message_of<WorkError>(
      [&] { (void)run_calculix(cantilever(mesh, "C3D8"), folder.path(), "beam"); });
  EXPECT_NE(message.find("calculix-ccx"), std::string::npos) << message;
}

TEST(CalculixDeck, RefusesWhatIsNoProblem) {
  const Mesh mesh = beam_mesh("hexa8", {1, 1, 1});
  CalculixProblem problem = cantilever(mesh, "C3D10");
  EXPECT_THROW((void)calculix_deck(problem), InternalError);
  problem.element_type = "C3D8";
  EXPECT_NO_THROW((void)calculix_deck(problem));
  problem.forces = {{8, 0, 1}};
  EXPECT_THROW((void)calculix_deck(problem), InternalError);
}

TEST(CalculixDeck, KeepsNumbersWithinTwentyCharacters) {
  Mesh mesh = beam_mesh("hexa8", {1, 1, 1});
  mesh.positions[0] = -1.0 / 3 * 1e-100;
  const std::string deck = calculix_deck(cantilever(mesh, "C3D8"));
  EXPECT_NE(deck.find("\n1,-3.33333333333e-101,0,0\n"), std::string::npos) << deck;
}

}  // namespace
}  // namespace elastogen::selector
