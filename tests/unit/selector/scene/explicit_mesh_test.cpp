#include "selector/scene/explicit_mesh.h"

#include <gtest/gtest.h>

#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

/// A unit hexahedron, and on its face x = 1 a pyramid.
const std::string scene_text = R"([mesh]
nodes = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
         [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1], [2, 0.5, 0.5]]
[[mesh.block]]
association = "stvk-hexa8-q8-none"
region = "cube"
elements = [[0, 1, 2, 3, 4, 5, 6, 7]]
[[mesh.block]]
association = "stvk-pyramid5-q5-none"
region = "cap"
elements = [[1, 2, 6, 5, 8]]
[material.rubber]
regions = ["cube", "cap"]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
)";

TEST(ExplicitMesh, TakesOverNodesAndElements) {
  const Problem problem = prepare_text(scene_text);
  const Mesh& mesh = problem.mesh.mesh;
  EXPECT_EQ(mesh.num_nodes(), 9U);
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[1].element, "pyramid5");
  EXPECT_EQ(mesh.blocks[1].nodes, (std::vector<std::int32_t>{1, 2, 6, 5, 8}));
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"cube", "cap"}));
  EXPECT_EQ(problem.mesh.split_quadrilaterals, 0U);
  EXPECT_TRUE(problem.mesh.section_x.empty());
}

TEST(ExplicitMesh, CountsQuadrilateralsThatMeetTwoTriangles) {
  std::string text = replaced(scene_text, "stvk-pyramid5-q5-none", "stvk-tet4-q1-none");
  text = replaced(text, "[[1, 2, 6, 5, 8]]", "[[1, 2, 5, 8], [2, 6, 5, 8]]");
  EXPECT_EQ(prepare_text(text).mesh.split_quadrilaterals, 1U);
}

TEST(ExplicitMesh, RejectsANodeOutsideTheMesh) {
  const std::string message =
      error_of(replaced(scene_text, "[[1, 2, 6, 5, 8]]", "[[1, 2, 6, 5, 9]]"));
  expect_contains(message, "mesh.block[2]: element 1 has the node 9");
  expect_contains(message, "from 0 to 8");
}

TEST(ExplicitMesh, RejectsANodeTwiceInAnElement) {
  expect_contains(error_of(replaced(scene_text, "[[1, 2, 6, 5, 8]]", "[[1, 2, 6, 6, 8]]")),
                  "has the node 6 twice");
}

TEST(ExplicitMesh, RejectsANodeInNoElement) {
  expect_contains(error_of(replaced(scene_text, "[2, 0.5, 0.5]]", "[2, 0.5, 0.5], [5, 5, 5]]")),
                  "node 9 belongs to no element");
}

TEST(ExplicitMesh, RejectsTheSameElementTwice) {
  expect_contains(
      error_of(replaced(scene_text, "[[1, 2, 6, 5, 8]]", "[[1, 2, 6, 5, 8], [2, 6, 5, 1, 8]]")),
      "elements 1 and 2 have the same nodes");
}

TEST(ExplicitMesh, RejectsAFaceOfThreeElements) {
  std::string text = replaced(scene_text, "[2, 0.5, 0.5]]", "[2, 0.5, 0.5], [3, 0.5, 0.5]]");
  text = replaced(text, "[[1, 2, 6, 5, 8]]", "[[1, 2, 6, 5, 8], [1, 2, 6, 5, 9]]");
  expect_contains(error_of(text), "belongs to more than two elements");
}

TEST(ExplicitMesh, RejectsTheWrongNumberOfNodes) {
  expect_contains(error_of(replaced(scene_text, "[[1, 2, 6, 5, 8]]", "[[1, 2, 6, 5]]")),
                  "scene.toml:11: mesh.block[2].elements = [ 1, 2, 6, 5 ]: must be an array of 5");
}

}  // namespace
}  // namespace elastogen::selector
