#include "selector/scene/bar_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "element_measures.h"
#include "selector/io/mesh_faces.h"
#include "selector/scene/cube_cuts.h"
#include "selector/scene/mid_edge_nodes.h"
#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

const std::map<std::string, std::string> associations = {
    {"hexa8", "stvk-hexa8-q8-none"},       {"prism6", "stvk-prism6-q6-none"},
    {"pyramid5", "stvk-pyramid5-q5-none"}, {"tet4", "stvk-tet4-q1-none"},
    {"hexa20", "stvk-hexa20-q8-none"},     {"tet10", "stvk-tet10-q4-none"}};

/// A bar of 3 x 0.7 x 0.4 m with one section for each element named.
BarDescription bar_of(const std::vector<std::string>& elements, std::array<int, 3> cells) {
  BarDescription bar;
  bar.cells_where = "scene.toml:2";
  bar.size = {3.0, 0.7, 0.4};
  bar.cells = cells;
  for (std::size_t s = 0; s < elements.size(); ++s) {
    SectionDescription section;
    section.until_where = "scene.toml:9";
    section.path = "bar.section[" + std::to_string(s + 1) + "]";
    section.until = static_cast<double>(s + 1) / static_cast<double>(elements.size());
    section.association = symgen::AssociationId::parse(associations.at(elements[s]));
    section.region = "body";
    bar.sections.push_back(section);
  }
  return bar;
}

class PureBar : public testing::TestWithParam<const char*> {};

TEST_P(PureBar, HasSoManyElementsPerCell) {
  const std::map<std::string, std::size_t> per_cell = {{"hexa8", 1}, {"prism6", 2}, {"pyramid5", 6},
                                                       {"tet4", 6},  {"hexa20", 1}, {"tet10", 6}};
  const SceneMesh bar = make_bar(bar_of({GetParam()}, {4, 3, 2}));
  EXPECT_EQ(bar.mesh.num_elements(), 4 * 3 * 2 * per_cell.at(GetParam()));
  const std::string element = GetParam();
  std::size_t nodes = 5 * 4 * 3;
  if (element == "pyramid5") nodes += 4 * 3 * 2;  // centres
  const std::size_t edges = 4 * 4 * 3 + 5 * 3 * 3 + 5 * 4 * 2;
  const std::size_t diagonals = (4 * 3 * 3 + 4 * 4 * 2 + 5 * 3 * 2) + 4 * 3 * 2;
  if (element == "hexa20") nodes += edges;
  if (element == "tet10") nodes += edges + diagonals;
  EXPECT_EQ(bar.mesh.num_nodes(), nodes);
}

TEST_P(PureBar, ElementsAreTurnedRightAndFillTheBar) {
  const SceneMesh bar = make_bar(bar_of({GetParam()}, {4, 3, 2}));
  const ElementBlock& block = bar.mesh.blocks.front();
  const ShapeGradients gradients(block.element);
  double total = 0;
  for (std::size_t e = 0; e < block.num_elements(); ++e) {
    const auto nodes = block.element_nodes(e);
    EXPECT_GT(gradients.least_jacobian(bar.mesh.positions, nodes), 0) << "element " << e;
    const double volume = volume_by_faces(bar.mesh.positions, nodes, block.element);
    EXPECT_GT(volume, 0) << "element " << e;
    total += volume;
  }
  EXPECT_NEAR(total, 3.0 * 0.7 * 0.4, 1e-14);
}

TEST_P(PureBar, FacesAreSharedByTwoOrLieOnTheSurface) {
  const SceneMesh bar = make_bar(bar_of({GetParam()}, {4, 3, 2}));
  const FaceMatching matching = match_faces(bar.mesh);
  EXPECT_TRUE(matching.overused.empty());
  EXPECT_TRUE(matching.split_quadrilaterals.empty());
  double area = 0;
  for (const MeshFace& face : matching.boundary) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const std::vector<std::int32_t> around = around_face(face.nodes);
    for (std::size_t i = 0; i < around.size(); ++i) {
      normal += node_position(bar.mesh.positions, around[i])
                    .cross(node_position(bar.mesh.positions, around[(i + 1) % around.size()]));
    }
    area += normal.norm() / 2;
  }
  EXPECT_NEAR(area, 2 * (3.0 * 0.7 + 3.0 * 0.4 + 0.7 * 0.4), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Elements, PureBar,
                         testing::Values("hexa8", "prism6", "pyramid5", "tet4", "hexa20", "tet10"));

TEST(CubeCut, TetrahedraShareTheMainDiagonal) {
  for (const std::vector<int>& tetrahedron : cube_cut("tet4").elements) {
    EXPECT_EQ(std::count(tetrahedron.begin(), tetrahedron.end(), 0), 1);
    EXPECT_EQ(std::count(tetrahedron.begin(), tetrahedron.end(), 6), 1);
  }
}

TEST(MixedBar, OnlyTheFaceBeforeTetrahedraIsSplit) {
  const SceneMesh bar = make_bar(bar_of({"prism6", "pyramid5", "hexa8", "tet4"}, {8, 3, 2}));
  EXPECT_EQ(bar.mesh.blocks.size(), 4U);
  EXPECT_EQ(bar.split_quadrilaterals, 3U * 2U);
  const FaceMatching matching = match_faces(bar.mesh);
  for (const std::size_t i : matching.split_quadrilaterals) {
    for (const std::int32_t node : matching.boundary[i].nodes) {
      EXPECT_DOUBLE_EQ(bar.mesh.positions[3 * static_cast<std::size_t>(node)], 0.75 * 3.0);
    }
  }
  // What is left after the split faces and their triangles is the surface of the four parts: whole
  // quadrilaterals but on the prisms' tops and bottoms and the tetrahedra.
  const std::size_t outside = surface_faces(matching).size();
  EXPECT_EQ(outside, matching.boundary.size() - 3 * matching.split_quadrilaterals.size());
}

TEST(MixedBar, SectionsHoldTheNodesOfTheirPlane) {
  const SceneMesh bar = make_bar(bar_of({"pyramid5", "tet4"}, {6, 2, 3}));
  ASSERT_EQ(bar.section_x.size(), 7U);
  std::size_t on_planes = 0;
  for (std::size_t i = 0; i < bar.section_x.size(); ++i) {
    EXPECT_EQ(bar.section_nodes[i].size(), 3U * 4U);
    for (const std::int32_t node : bar.section_nodes[i]) {
      EXPECT_DOUBLE_EQ(bar.mesh.positions[3 * static_cast<std::size_t>(node)], bar.section_x[i]);
      ++on_planes;
    }
  }
  EXPECT_EQ(bar.mesh.num_nodes() - on_planes, 3U * 2U * 3U) << "the centres of the pyramids' cells";
}

TEST(QuadraticBar, HasItsNodesPlaneByPlaneAndInItsSections) {
  const SceneMesh bar = make_bar(bar_of({"hexa20", "tet10"}, {6, 2, 3}));
  EXPECT_TRUE(std::is_sorted(bar.section_nodes.front().begin(), bar.section_nodes.front().end()));
  std::vector<double> x;
  for (std::size_t node = 0; node < bar.mesh.num_nodes(); ++node) {
    x.push_back(bar.mesh.positions[3 * node]);
  }
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
  ASSERT_EQ(bar.section_nodes.size(), 7U);
  const std::size_t corners = 3 * 4, edges = 3 * 3 + 2 * 4, diagonals = 2 * 3;
  for (std::size_t i = 0; i < 7; ++i) {
    // Of both meshes in the plane between them: hexa20 and tet10 share the nodes of their edges.
    EXPECT_EQ(bar.section_nodes[i].size(), corners + edges + (i >= 3 ? diagonals : 0)) << i;
    for (const std::int32_t node : bar.section_nodes[i]) {
      EXPECT_DOUBLE_EQ(x[static_cast<std::size_t>(node)], bar.section_x[i]);
    }
  }
  EXPECT_EQ(bar.split_quadrilaterals, 2U * 3U);
  EXPECT_EQ(bar.unequal_faces, 0U);
}

TEST(QuadraticBar, DoesNotFitLinearHexahedra) {
  const SceneMesh bar = make_bar(bar_of({"hexa8", "hexa20"}, {4, 2, 3}));
  EXPECT_EQ(bar.unequal_faces, 2U * 2U * 3U);
  EXPECT_EQ(surface_faces(match_faces(bar.mesh)).size(), 2U * (4 * 2 + 4 * 3 + 2 * 3));
}

TEST(MidEdgeNodes, SayBetweenWhichNodesTheyLie) {
  Mesh mesh = make_bar(bar_of({"tet4"}, {1, 1, 1})).mesh;
  const std::size_t corners = mesh.num_nodes();
  const std::vector<MidEdgeNode> made = add_mid_edge_nodes(mesh, {{0, "tet10"}});
  EXPECT_EQ(made.size(), 12U + 6 + 1);
  EXPECT_EQ(mesh.num_nodes(), corners + made.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    EXPECT_EQ(made[k].node, static_cast<std::int32_t>(corners + k));
    EXPECT_LT(made[k].a, made[k].b);
    const Eigen::Vector3d middle =
        (node_position(mesh.positions, made[k].a) + node_position(mesh.positions, made[k].b)) / 2;
    EXPECT_EQ(node_position(mesh.positions, made[k].node), middle);
  }
  EXPECT_THROW((void)add_mid_edge_nodes(mesh, {{0, "hexa20"}}), InternalError);
}

/// The box of every bar's middle third, wide and high as the bar.
InclusionDescription middle_third() {
  InclusionDescription inclusion;
  inclusion.path = "bar.inclusion[1]";
  inclusion.box.where = "scene.toml:20";
  inclusion.box.minimum = {1, 0, 0};
  inclusion.box.maximum = {2, 1, 1};
  inclusion.region = "stiff";
  return inclusion;
}

TEST(Inclusion, TakesTheElementsWhoseMiddleItHolds) {
  BarDescription description = bar_of({"hexa8", "tet4", "hexa20"}, {12, 2, 3});
  const SceneMesh without = make_bar(description);
  description.inclusions = {middle_third()};
  const SceneMesh bar = make_bar(description);
  ASSERT_EQ(bar.mesh.num_elements(), without.mesh.num_elements());
  EXPECT_EQ(bar.mesh.positions, without.mesh.positions);
  ASSERT_EQ(bar.mesh.blocks.size(), bar.blocks.size());
  const auto stiff = std::find(bar.mesh.region_names.begin(), bar.mesh.region_names.end(), "stiff");
  ASSERT_NE(stiff, bar.mesh.region_names.end());
  const auto number = static_cast<std::int32_t>(stiff - bar.mesh.region_names.begin());
  std::size_t inside = 0;
  for (std::size_t b = 0; b < bar.mesh.blocks.size(); ++b) {
    const ElementBlock& block = bar.mesh.blocks[b];
    EXPECT_EQ(bar.blocks[b].association.element, block.element);
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      double x = 0;
      for (const std::int32_t node : block.element_nodes(e)) {
        x += bar.mesh.positions[3 * static_cast<std::size_t>(node)] / block.nodes_per_element;
      }
      EXPECT_EQ(block.region[e] == number, x >= 1 && x <= 2);
      EXPECT_EQ(bar.blocks[b].region == "stiff", block.region[e] == number);
      if (block.region[e] == number) ++inside;
    }
  }
  EXPECT_EQ(inside, 4U * 2 * 3 * 6);  // the tetrahedra are the middle third
}

TEST(Inclusion, MustHoldAnElement) {
  BarDescription description = bar_of({"hexa8"}, {3, 1, 1});
  description.inclusions = {middle_third()};
  description.inclusions[0].box.maximum = {1.2, 1, 1};
  try {
    (void)make_bar(description);
    FAIL() << "the box ends before the middle of the second cell";
  } catch (const InputError& error) {
    expect_contains(error.what(), "scene.toml:20: bar.inclusion[1].box holds no element");
  }
}

TEST(MixedBar, RejectsASectionThatEndsInsideACell) {
  try {
    (void)make_bar(bar_of({"hexa8", "tet4", "hexa8"}, {8, 1, 1}));
    FAIL() << "8 cells are not divisible by 3";
  } catch (const InputError& error) {
    expect_contains(error.what(), "scene.toml:9: bar.section[1].until = 0.333");
    expect_contains(error.what(), "after 2.66667 of the bar's 8 cells");
    expect_contains(error.what(), "until = 0.375");
  }
}

TEST(MixedBar, RejectsMoreNodesThanCanBeNumbered) {
  EXPECT_THROW((void)make_bar(bar_of({"hexa8"}, {2000, 1000, 1000})), InputError);
}

}  // namespace
}  // namespace elastogen::selector
