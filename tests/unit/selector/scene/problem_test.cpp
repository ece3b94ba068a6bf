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
  const std::vector<std::int32_t> nodes = select_nodes(problem.mesh, selection);
  EXPECT_EQ(nodes.size(), 2U) << "(1, 0, 1) and (2, 0, 1)";
}

/// Constraints on the good scene's bar: nodes at (x, y, z) with their fixed components.
int free_motions(const std::vector<std::pair<std::array<double, 3>, std::string>>& fixed) {
  const SceneMesh mesh = prepare_text(good_scene).mesh;
  Constraints constraints(mesh.mesh.num_nodes(), 3);
  for (const auto& [at, components] : fixed) {
    NodeSelection selection;
    selection.minimum = selection.maximum = at;
    for (const std::int32_t node : select_nodes(mesh, selection)) {
      for (const char c : components) constraints.fix(static_cast<std::size_t>(node), c - 'x');
    }
  }
  return find_free_rigid_motion(mesh.mesh, constraints).count;
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

/// A plane bar of triangles, then quadrilaterals, clamped at x = 0.
const std::string plane_scene = R"(gravity = [0, -9.81]
[bar]
length = 2.0
height = 1.0
cells = [4, 2]
[[bar.section]]
until = 0.5
association = "stvk-tri3-q1-none"
region = "body"
[[bar.section]]
until = 1.0
association = "stvk-quad4-q4-none"
region = "body"
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y"]
)";

TEST(PlaneScene, HasTwoComponentsOfEverything) {
  const Problem problem = prepare_text(plane_scene);
  const Mesh& mesh = problem.mesh.mesh;
  EXPECT_EQ(mesh.dim, 2);
  EXPECT_EQ(mesh.num_nodes(), 15U);
  EXPECT_EQ(mesh.num_elements(), 8U + 4U);
  EXPECT_EQ(problem.constraints.num_dofs(), 30U);
  EXPECT_EQ(problem.constraints.num_constrained(), 6U);
  EXPECT_EQ(problem.mesh.section_nodes.front().size(), 3U);
}

TEST(PlaneScene, TilesTheBarWithElementsThatAreNotInverted) {
  const Problem problem = prepare_text(plane_scene);
  const Mesh& mesh = problem.mesh.mesh;
  double area = 0;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const auto nodes = block.element_nodes(e);
      double twice = 0;  // the shoelace formula
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const double* p = &mesh.positions[2 * static_cast<std::size_t>(nodes[a])];
        const double* q =
            &mesh.positions[2 * static_cast<std::size_t>(nodes[(a + 1) % nodes.size()])];
        twice += p[0] * q[1] - p[1] * q[0];
      }
      EXPECT_GT(twice, 0);
      area += twice / 2;
    }
  }
  EXPECT_NEAR(area, 2.0, 1e-14);
}

TEST(PlaneScene, RefusesVectorsOfSpace) {
  const auto message = [](const char* piece, const char* by) {
    return error_of(replaced(plane_scene, piece, by));
  };
  expect_contains(message("[0, -9.81]", "[0, 0, -9.81]"),
                  "must have the 2 components, not 3: the scene is plane, with x and y");
  expect_contains(message("[\"x\", \"y\"]", "[\"x\", \"z\"]"),
                  "'z' is no component: x, y are in a plane scene");
  expect_contains(message("cells = [4, 2]", "cells = [4, 2, 2]"), "must have 2 entries, not 3");
  expect_contains(message("{ x = 0.0 }", "{ z = 0.0 }"), "unknown key");
}

TEST(PlaneScene, TakesPressureOnItsEdges) {
  const Problem problem =
      prepare_text(replaced(plane_scene, "[[constraint]]",
                            "[[load]]\nplane = { y = 1 }\npressure = 100\n[[load]]\nplane = { x = "
                            "2 }\ntraction = [30, 0]\n[[constraint]]"));
  ASSERT_EQ(problem.surface_loads.size(), 2U);
  EXPECT_EQ(problem.surface_loads[0].faces.size(), 4U);
  EXPECT_NEAR(problem.surface_loads[0].area, 2, 1e-14);  // 1 m thick
  EXPECT_NEAR(problem.surface_loads[0].resultant[1], -200, 1e-12);
  EXPECT_NEAR(problem.surface_loads[1].resultant[0], 30, 1e-13);
}

TEST(PlaneScene, RefusesElementsOfSpace) {
  const std::string message = error_of(replaced(plane_scene, "stvk-tri3-q1", "stvk-tet4-q1"));
  expect_contains(message, "element 'tet4' is three-dimensional, but the scene is plane");
  expect_contains(message, "take tri3, quad4");
  expect_contains(error_of(replaced(good_scene, "hexa8-q8", "quad4-q4")),
                  "element 'quad4' is plane, but the scene is in space");
  expect_contains(error_of(replaced(good_scene, "[0, 0, -9.81]", "[0, -9.81]")),
                  "must have the 3 components, not 2");
}

TEST(PlaneScene, HasThreeRigidMotions) {
  expect_contains(error_of(replaced(plane_scene, "[\"x\", \"y\"]", "[\"x\"]")),
                  "leave 1 of the 3 rigid motions of the body, for example a translation along y");
  expect_contains(error_of(replaced(plane_scene, "plane = { x = 0.0 }",
                                    "box = { min = [0, 0], max = [0, 0] }")),
                  "a rotation about an axis along z");
}

TEST(PlaneScene, FindsOverlappingElementsByHand) {
  const std::string mesh = R"([mesh]
nodes = [[0, 0], [1, 0], [0, 1], [1, 1], [0.5, 2]]
[[mesh.block]]
association = "stvk-tri3-q1-none"
region = "body"
elements = [[0, 1, 2], [0, 1, 3], [0, 1, 4]]
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { y = 0 }
fixed = ["x", "y"]
)";
  expect_contains(error_of(mesh), "the edge with nodes 0 1 of element 0 belongs to more than two");
  expect_contains(error_of(replaced(mesh, "[0, 0], [1, 0]", "[0, 0, 0], [1, 0]")),
                  "must be an array of 2 numbers");
}

}  // namespace
}  // namespace elastogen::selector
