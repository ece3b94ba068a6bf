// Meshes from VTK's files: every version, every cell, regions from cell arrays, and damage.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <numeric>

#include "../scene/temporary_scene.h"
#include "mesh_file_errors.h"
#include "selector/io/displacement_field.h"
#include "selector/io/mesh_file.h"
#include "selector/io/vtu.h"
#include "selector/scene/scene_mesh.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(ELASTOGEN_TEST_DATA) / "meshes" / name;
}

void expect_equal(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.region_names, b.region_names);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].element, b.blocks[i].element);
    EXPECT_EQ(a.blocks[i].nodes, b.blocks[i].nodes);
    EXPECT_EQ(a.blocks[i].region, b.blocks[i].region);
  }
}

TEST(VtkFile, HoldsTheSameMeshInEveryVersion) {
  const MeshFile oldest = read_mesh_file(data("beam42.vtk"));
  EXPECT_EQ(oldest.mesh.num_nodes(), 45U);
  EXPECT_EQ(oldest.mesh.num_elements(), 16U);
  for (const char* name : {"beam51.vtk", "beam51b.vtk", "beam_voxels.vtk"}) {
    SCOPED_TRACE(name);
    const MeshFile read = read_mesh_file(data(name));
    EXPECT_TRUE(read.notes.empty()) << ::testing::PrintToString(read.notes);
    expect_equal(read.mesh, oldest.mesh);
  }
}

/// A unit square of two triangles and, beside it, one of a pixel; three lines below.
const std::string plane_text = R"(# vtk DataFile Version 3.0
plane
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 6 double
0 0 7  1 0 7  1 1 7  0 1 7  2 0 7  2 1 7
CELLS 5 19
3 0 1 2
3 0 2 3
4 1 4 2 5
2 0 1
2 1 4
CELL_TYPES 5
5 5 8 3 3
CELL_DATA 5
FIELD FieldData 2
MaterialIds 1 5 int
4 4 9 2 2
mean 1 5 double
0.5 1 1 1 1
)";

TEST(VtkFile, GivesRegionsAndBoundariesByACellArray) {
  const TemporaryFolder folder;
  const MeshFile read = read_mesh_file(write_file(folder, "plane.vtk", plane_text));
  EXPECT_EQ(read.mesh.dim, 2);
  EXPECT_EQ(read.mesh.region_names, (std::vector<std::string>{"4", "9"}));
  ASSERT_EQ(read.mesh.blocks.size(), 2U);
  EXPECT_EQ(read.mesh.blocks[1].element, "quad4");
  EXPECT_EQ(read.mesh.blocks[1].nodes, (std::vector<std::int32_t>{1, 4, 5, 2}));
  ASSERT_EQ(read.boundaries.size(), 1U);
  EXPECT_EQ(read.boundaries[0].name, "2");
  EXPECT_EQ(read.boundaries[0].nodes, (std::vector<std::int32_t>{0, 1, 4}));
  EXPECT_EQ(read.boundaries[0].faces.size(), 2U);
}

TEST(VtkFile, TakesTheArrayThatTheSceneNames) {
  const TemporaryFolder folder;
  const auto file = write_file(folder, "plane.vtk", replaced(plane_text, "MaterialIds", "parts"));
  EXPECT_EQ(read_mesh_file(file).mesh.region_names, std::vector<std::string>{default_region});
  EXPECT_EQ(read_mesh_file(file, {{}, "parts"}).mesh.region_names,
            (std::vector<std::string>{"4", "9"}));
  expect_words(error_of_file(file, {{}, "part"}),
               {"plane.vtk: ", "no cell array 'part'", "it has: 'parts', 'mean'"});
  expect_words(error_of_file(file, {{}, "mean"}), {"'mean'", "not integers"});
  expect_words(error_of_file(data("house4.msh"), {{}, "parts"}),
               {"house4.msh: regions = \"parts\"", "only .vtk and .vtu"});
}

TEST(VtkFile, IsRefusedByTheNameOfACellThatCannotBeComputed) {
  const TemporaryFolder folder;
  std::string text =
      "# vtk DataFile Version 3.0\nwedge\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 15 double\n";
  for (int i = 0; i < 45; ++i) text += std::to_string(i * i % 7) + "\n";
  text += "CELLS 1 16\n15 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14\nCELL_TYPES 1\n26\n";
  expect_words(error_of_file(write_file(folder, "wedge.vtk", text)),
               {"wedge.vtk: ", "1 of type 'vtkQuadraticWedge'", "prism6"});
}

TEST(VtkFile, IsCalledDamagedOnlyWhereItIs) {
  const TemporaryFolder folder;
  const auto cut = [&](const char* name, std::size_t length) {
    const std::string whole = read_text_file(data(name), "mesh");
    return error_of_file(write_file(folder, "cut.vtk", whole.substr(0, length)));
  };
  expect_words(cut("beam51.vtk", 900), {"cut.vtk: ", "cut short: VTK says: Error reading ascii"});
  expect_words(cut("beam51b.vtk", 1500), {"cut short: VTK says: Error reading binary"});
  expect_words(cut("beam42.vtk", 60), {"cut.vtk: ", "vtk cannot read it"});
  const std::string whole = read_text_file(data("beam51.vtk"), "mesh");
  expect_words(
      error_of_file(write_file(folder, "bad.vtk", replaced(whole, "\n8 18 19", "\n8 18 99"))),
      {"damaged: cell 3 has the point 99: they are numbered from 0 to 44"});
  expect_words(error_of_file(write_file(folder, "no.vtu", "not a mesh\n")),
               {"neither a legacy file of VTK", "nor a sound XML file"});
  const std::string points =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 "
      "double\n0 0 0\n";
  expect_words(error_of_file(write_file(folder, "points.vtk", points)),
               {"holds a vtkPolyData", "Append Datasets"});
}

const std::string mixed_bar = R"([bar]
length = 4.0
width = 1.0
height = 1.0
cells = [4, 2, 1]
[[bar.section]]
until = 0.25
association = "stvk-prism6-q6-none"
region = "left end"
[[bar.section]]
until = 0.50
association = "stvk-pyramid5-q5-none"
region = "left end"
[[bar.section]]
until = 0.75
association = "stvk-hexa20-q8-none"
region = "right"
[[bar.section]]
until = 1.00
association = "stvk-tet10-q4-none"
region = "right"
[material.any]
regions = ["left end", "right"]
density = 1
)";

ElementLabels regions_of(const Mesh& mesh) {
  ElementLabels regions{"region", {}, mesh.region_names};
  for (const ElementBlock& block : mesh.blocks) {
    regions.values.insert(regions.values.end(), block.region.begin(), block.region.end());
  }
  return regions;
}

TEST(VtuFile, IsReadBackAsItWasWritten) {
  const Mesh mesh = make_mesh(read_text(mixed_bar)).mesh;
  const TemporaryFolder folder;
  write_vtu(folder.path() / "result.vtu", mesh, {{}, {}, {regions_of(mesh)}});
  const MeshFile read = read_mesh_file(folder.path() / "result.vtu");
  EXPECT_TRUE(read.notes.empty()) << ::testing::PrintToString(read.notes);
  expect_equal(read.mesh, mesh);
}

TEST(VtuFile, IsReadAsEarlierVersionsWroteIt) {
  const Mesh mesh = make_mesh(read_text(mixed_bar)).mesh;
  const std::vector<double> displacement(mesh.positions.size(), 0.25);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "result.vtu";
  write_vtu(file, mesh, {{{"displacement", displacement}}, {}, {regions_of(mesh)}});
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkNew<vtkStringArray> names;
  names->SetName("region_names");
  for (const std::string& name : mesh.region_names) names->InsertNextValue(name);
  reader->GetOutput()->GetFieldData()->RemoveArray("region_names");
  reader->GetOutput()->GetFieldData()->AddArray(names);
  const std::filesystem::path earlier = folder.path() / "earlier.vtu";
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(reader->GetOutput());
  writer->SetFileName(earlier.c_str());
  writer->SetCompressorTypeToLZ4();
  writer->EncodeAppendedDataOff();
  ASSERT_EQ(writer->Write(), 1);
  expect_equal(read_mesh_file(earlier).mesh, mesh);
  EXPECT_EQ(displacements_at(earlier, {mesh.positions.data(), 3}, 3),
            (std::vector<double>{0.25, 0.25, 0.25}));
}

}  // namespace
}  // namespace elastogen::selector
