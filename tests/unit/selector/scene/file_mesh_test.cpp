// Scenes with a mesh file: dimensions, numbers in messages, nodes that lie on each other.
#include "selector/scene/file_mesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "selector/io/coincident_nodes.h"
#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

std::string data(const std::string& name) {
  return ELASTOGEN_TEST_DATA "/meshes/" + name;
}

/// A scene of a mesh file, of one region, clamped at x = 0.
std::string scene_of(const std::string& file, const std::string& region,
                     const std::string& more = "") {
  return fmt::format(R"([mesh]
file = "{}"
law = "stvk"
{}
[material.{}]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = {{ x = 0.0 }}
fixed = ["x", "y"]
)",
                     file, more, region);
}

std::string in_space(const std::string& scene) {
  return replaced(scene, "[\"x\", \"y\"]", "[\"x\", \"y\", \"z\"]");
}

TEST(FileMesh, HasTheDimensionsOfItsElements) {
  const TemporaryFolder folder;
  const std::string plate = write_file(folder, "plate.inp",
                                       "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n"
                                       "*ELEMENT,TYPE=CPE4\n7,1,2,3,4\n")
                                .string();
  EXPECT_EQ(prepare_text(scene_of(plate, "default")).mesh.mesh.dim, 2);
  EXPECT_EQ(prepare_text(scene_of(plate, "default", "dim = 2")).mesh.mesh.dim, 2);
  EXPECT_EQ(prepare_text(in_space(scene_of(data("beam51.vtk"), "default"))).mesh.mesh.dim, 3);
  expect_contains(error_of(scene_of(plate, "default", "dim = 3")),
                  "mesh.dim = 3: the mesh file has no solid elements, so it is plane");
  expect_contains(error_of(scene_of(data("beam51.vtk"), "default", "dim = 2")),
                  "mesh.dim = 2: the mesh file has solid elements");
  expect_contains(error_of(in_space(scene_of(plate, "default"))), "are in a plane scene");
}

// Two halves that nothing joins: the nodes at x = 1 are there twice.
TEST(FileMesh, SaysThatPartsMayBeMeantToBeOne) {
  const std::string vtk = error_of(in_space(scene_of(data("doubled.vtk"), "default")));
  expect_contains(vtk, "the part with node 3 (the mesh has 2 parts)");
  expect_contains(vtk, "9 nodes lie on another node (node 45 on node 2 first)");
  expect_contains(vtk, "Clean to Grid");
  const std::string msh = error_of(in_space(scene_of(data("doubled.msh"), "1")));
  expect_contains(msh, "the part with node 1000 (the mesh has 2 parts)");
  expect_contains(msh, "9 nodes lie on another node (node ");
  expect_contains(msh, "Coherence Mesh");
}

TEST(FileMesh, SaysWhatABoundaryIs) {
  const std::string by_name = replaced(in_space(scene_of(data("house4.msh"), "house")),
                                       "plane = { x = 0.0 }", "boundary = \"roof\"") +
                              "[material.roof]\ndensity = 1\nyoung = 1\npoisson = 0\n";
  const std::string message = error_of(by_name);
  expect_contains(message, "the mesh has none of this name");
  expect_contains(message, "the region of this name is no boundary");
  expect_contains(message, "Physical Surface(\"NAME\")");
}

TEST(FileMesh, NamesNodesByTheirNumbersInTheFile) {
  const std::string scene = in_space(scene_of(data("doubled.msh"), "1")) +
                            "[[constraint]]\nplane = { x = 0.0 }\ndisplacement = { z = 1.0 }\n";
  expect_contains(error_of(scene),
                  "constraint: along z node 1021 is given the displacement 1 here");
}

/// Two tetrahedra of edges 1 and of `edge`, the first nodes of which are `gap` apart.
Mesh two_tetrahedra(double edge, double gap, double offset) {
  Mesh mesh;
  const double h = edge;
  for (const double x : {0.,  0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.,  //
                         gap, 0., 0., -h, 0., 0., 0., -h, 0., 0., 0., -h}) {
    mesh.positions.push_back(x + offset);
  }
  mesh.blocks = {{"tet4", 4, {0, 1, 2, 3, 4, 5, 6, 7}, {0, 0}}};
  mesh.region_names = {"body"};
  return mesh;
}

TEST(CoincidentNodes, AreFoundByTheSizeOfTheirElements) {
  for (const double offset : {0., 1e4, -1e6}) {
    SCOPED_TRACE(offset);
    for (const double edge : {1., 1e-2}) {
      EXPECT_EQ(find_coincident_nodes(two_tetrahedra(edge, 0, offset)).count, 1U);
      EXPECT_EQ(find_coincident_nodes(two_tetrahedra(edge, 1e-9 * edge, offset)).count, 1U);
      EXPECT_EQ(find_coincident_nodes(two_tetrahedra(edge, 1e-3 * edge, offset)).count, 0U);
    }
  }
  EXPECT_EQ(find_coincident_nodes(two_tetrahedra(1, 0, 0)).first,
            (std::array<std::size_t, 2>{0, 4}));
}

// A billionth of the distance from the origin is ten elements here.
TEST(CoincidentNodes, AreNotSeenInAFineMeshFarFromTheOrigin) {
  Mesh mesh;
  const int n = 6;
  const double h = 1e-7;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) mesh.positions.insert(mesh.positions.end(), {1e3 + i * h, j * h});
  }
  mesh.dim = 2;
  ElementBlock block{"quad4", 4, {}, {}};
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const int first = i * n + j;
      block.nodes.insert(block.nodes.end(), {first, first + n, first + n + 1, first + 1});
      block.region.push_back(0);
    }
  }
  mesh.blocks = {block};
  EXPECT_EQ(find_coincident_nodes(mesh).count, 0U);
}

}  // namespace
}  // namespace elastogen::selector
