#include "selector/scene/problem.h"

#include <gtest/gtest.h>

#include <fstream>

#include "selector/scene/rigid_motions.h"
#include "selector/scene/select_nodes.h"
#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

TEST(Problem, TakesLameParametersFromYoungAndPoisson) {
  const Problem problem = prepare_text(good_scene);
  const symgen::Law& law = problem.laws.at("stvk");
  ASSERT_EQ(law.parameters.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) {
    const double expected = law.parameters[p].name == "mu" ? 1e6 / 2.6 : 1e6 * 0.3 / (1.3 * 0.4);
    EXPECT_NEAR(problem.materials[0].parameters[p], expected, 1e-9 * expected);
  }
  EXPECT_EQ(problem.materials[0].density, 1000);
}

TEST(Problem, TakesTheLawsOwnParameters) {
  const Problem problem =
      prepare_text(replaced(good_scene, "young = 1e6\npoisson = 0.3", "lambda = 3.0\nmu = 2.0"));
  const symgen::Law& law = problem.laws.at("stvk");
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(problem.materials[0].parameters[p], law.parameters[p].name == "mu" ? 2.0 : 3.0);
  }
}

TEST(Problem, FindsALawBesideTheScene) {
  const TemporaryFolder folder;
  std::ifstream shipped(std::string(ELASTOGEN_SOURCE_DIR) + "/laws/stvk.toml");
  std::string text(std::istreambuf_iterator<char>(shipped), {});
  write_file(folder, "mine.toml", replaced(text, "\"stvk\"", "\"mine\""));
  std::string scene = replaced(good_scene, "gravity", "laws = [\"mine.toml\"]\ngravity");
  scene = replaced(scene, "stvk-", "mine-");
  const Problem problem = prepare(read_scene(write_file(folder, "scene.toml", scene)), {});
  EXPECT_TRUE(problem.laws.contains("mine"));
}

TEST(Problem, SpreadsALoadOverItsNodes) {
  const Problem problem = prepare_text(
      replaced(good_scene, "[[constraint]]",
               "[[load]]\nplane = { x = 2.0 }\nforce = [4.0, 0, -8.0]\n[[constraint]]"));
  ASSERT_EQ(problem.forces.size(), 4U);
  for (const NodalForce& force : problem.forces) {
    EXPECT_EQ(force.force, (std::array<double, 3>{1, 0, -2}));
    EXPECT_EQ(problem.mesh.mesh.positions[3 * force.node], 2.0);
  }
}

TEST(Problem, PrescribesDisplacements) {
  const Problem problem =
      prepare_text(replaced(good_scene, "fixed = [\"x\", \"y\", \"z\"]",
                            "fixed = [\"x\", \"y\", \"z\"]\n[[constraint]]\nplane = { x = 2.0 }\n"
                            "displacement = { z = -0.25 }"));
  EXPECT_EQ(problem.constraints.num_constrained(), 4U * 3U + 4U);
  for (std::size_t node = 0; node < problem.mesh.mesh.num_nodes(); ++node) {
    const bool at_end = problem.mesh.mesh.positions[3 * node] == 2.0;
    EXPECT_EQ(problem.constraints.value(3 * node + 2), at_end ? -0.25 : 0.0);
  }
}

TEST(SelectNodes, ByBox) {
  const Problem problem = prepare_text(good_scene);
  NodeSelection selection;
  selection.minimum = {0.5, -1, 0.5};
  selection.maximum = {2, 0.5, 3};
  const std::vector<std::int32_t> nodes = select_nodes(problem.mesh.mesh, selection);
  EXPECT_EQ(nodes.size(), 2U) << "(1, 0, 1) and (2, 0, 1)";
}

/// Constraints on the good scene's bar: nodes at (x, y, z) with their fixed components.
int free_motions(const std::vector<std::pair<std::array<double, 3>, std::string>>& fixed) {
  const Mesh mesh = prepare_text(good_scene).mesh.mesh;
  Constraints constraints(mesh.num_nodes(), 3);
  for (const auto& [at, components] : fixed) {
    NodeSelection selection;
    selection.minimum = selection.maximum = at;
    for (const std::int32_t node : select_nodes(mesh, selection)) {
      for (const char c : components) constraints.fix(static_cast<std::size_t>(node), c - 'x');
    }
  }
  return find_free_rigid_motion(mesh, constraints).count;
}

TEST(RigidMotions, AreCounted) {
  EXPECT_EQ(free_motions({{{0, 0, 0}, "x"}}), 5);
  EXPECT_EQ(free_motions({{{0, 0, 0}, "xyz"}}), 3) << "rotations about the node";
  EXPECT_EQ(free_motions({{{0, 0, 0}, "xyz"}, {{2, 0, 0}, "xyz"}}), 1) << "about the line";
  EXPECT_EQ(free_motions({{{0, 0, 0}, "xyz"}, {{2, 0, 0}, "yz"}, {{0, 1, 0}, "z"}}), 0)
      << "six that are independent";
  EXPECT_EQ(free_motions({{{0, 0, 0}, "xyz"}, {{2, 0, 0}, "yz"}, {{0, 1, 0}, "x"}}), 1)
      << "six that are not";
}

TEST(RigidMotions, AreLookedForInEveryPart) {
  const std::string two_parts = R"([mesh]
nodes = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [5, 0, 0], [6, 0, 0], [5, 1, 0], [5, 0, 1]]
[[mesh.block]]
association = "stvk-tet4-q1-none"
region = "body"
elements = [[0, 1, 2, 3], [4, 5, 6, 7]]
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
box = { min = [0, 0, 0], max = [1, 1, 1] }
fixed = ["x", "y", "z"]
)";
  const std::string message = error_of(two_parts);
  expect_contains(message, "leave 6 of the 6 rigid motions");
  expect_contains(message, "the part with node 4 (the mesh has 2 parts)");
}

class ShippedScene : public testing::TestWithParam<const char*> {};

TEST_P(ShippedScene, IsReadyAndHasAbout3000Elements) {
  const std::string source = ELASTOGEN_SOURCE_DIR;
  const Scene scene = read_scene(source + "/scenes/" + GetParam() + ".toml");
  const Problem problem = prepare(scene, {source + "/laws"});
  EXPECT_NEAR(static_cast<double>(problem.mesh.mesh.num_elements()), 3000, 100);
  EXPECT_TRUE(problem.reference.has_value());
  EXPECT_EQ(problem.probes.size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene,
                         testing::Values("mixed_beam", "mixed_beam_hooke_prisms", "beam_hexa8",
                                         "beam_prism6", "beam_pyramid5", "beam_tet4"));

}  // namespace
}  // namespace elastogen::selector
