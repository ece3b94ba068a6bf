#include "selector/io/vtu.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "../scene/element_measures.h"
#include "../scene/temporary_scene.h"
#include "selector/scene/scene_mesh.h"
#include "selector/support/process.h"

namespace elastogen::selector {
namespace {

const std::string mixed_scene = R"([bar]
length = 4.0
width = 1.0
height = 1.0
cells = [4, 1, 1]
[[bar.section]]
until = 0.25
association = "stvk-prism6-q6-none"
region = "left"
[[bar.section]]
until = 0.50
association = "stvk-pyramid5-q5-none"
region = "left"
[[bar.section]]
until = 0.75
association = "stvk-hexa8-q8-none"
region = "right"
[[bar.section]]
until = 1.00
association = "stvk-tet4-q1-none"
region = "right"
[material.any]
regions = ["left", "right"]
density = 1
)";

class VtuRoundTrip : public testing::Test {
 protected:
  void SetUp() override {
    mesh_ = make_mesh(read_text(mixed_scene)).mesh;
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
      displacement_.push_back(0.001 * static_cast<double>(i * i));
    }
    ElementLabels regions{"region", {}, mesh_.region_names};
    for (const ElementBlock& block : mesh_.blocks) {
      regions.values.insert(regions.values.end(), block.region.begin(), block.region.end());
    }
    for (std::size_t e = 0; e < mesh_.num_elements(); ++e) {
      energy_.push_back(0.5 * static_cast<double>(e));
    }
    const std::filesystem::path file = folder_.path() / "result.vtu";
    write_vtu(file, mesh_, {{{"displacement", displacement_}}, {{"energy", energy_}}, {regions}});
    reader_->SetFileName(file.c_str());
    reader_->Update();
    grid_ = reader_->GetOutput();
  }

  TemporaryFolder folder_;
  Mesh mesh_;
  std::vector<double> displacement_, energy_;
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
  vtkUnstructuredGrid* grid_ = nullptr;
};

TEST_F(VtuRoundTrip, KeepsNodesAndFields) {
  ASSERT_EQ(grid_->GetNumberOfPoints(), static_cast<vtkIdType>(mesh_.num_nodes()));
  vtkDataArray* displacement = grid_->GetPointData()->GetArray("displacement");
  ASSERT_NE(displacement, nullptr);
  for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
    const auto id = static_cast<vtkIdType>(node);
    for (int c = 0; c < 3; ++c) {
      const std::size_t dof = 3 * node + static_cast<std::size_t>(c);
      EXPECT_EQ(grid_->GetPoint(id)[c], mesh_.positions[dof]);
      EXPECT_EQ(displacement->GetComponent(id, c), displacement_[dof]);
    }
  }
  vtkDataArray* energy = grid_->GetCellData()->GetArray("energy");
  ASSERT_NE(energy, nullptr);
  for (std::size_t e = 0; e < energy_.size(); ++e) {
    EXPECT_EQ(energy->GetComponent(static_cast<vtkIdType>(e), 0), energy_[e]);
  }
}

/// The Python that has meshio: the user's, or the system's, whose packages Debian brings.
std::string python_with_meshio() {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    if (!find_program(python)) continue;
    if (run_process({python, "-c", "import meshio"}).exit_status == 0) return python;
  }
  return "";
}

TEST_F(VtuRoundTrip, IsReadByMeshio) {
  const std::string python = python_with_meshio();
  if (python.empty()) GTEST_SKIP() << "meshio is not installed (package python3-meshio)";
  const char* script = R"(import sys, meshio
mesh = meshio.read(sys.argv[1])
u = mesh.point_data["displacement"]
names = bytes(mesh.field_data["region_names"]).decode().split("\n")
print(len(mesh.points), sum(len(block.data) for block in mesh.cells), u.shape[1], float(u[1][2]),
      sum(float(e) for values in mesh.cell_data["energy"] for e in values), names[0], names[1])
)";
  const ProcessResult result =
      run_process({python, "-c", script, (folder_.path() / "result.vtu").string()});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  const auto n = static_cast<double>(mesh_.num_elements());
  EXPECT_EQ(result.output,
            fmt::format("{} {} 3 {} {} left right\n", mesh_.num_nodes(), mesh_.num_elements(),
                        displacement_[5], fmt::format("{:.1f}", 0.25 * n * (n - 1))));
}

TEST_F(VtuRoundTrip, NamesTheLabels) {
  auto* names =
      vtkUnsignedCharArray::SafeDownCast(grid_->GetFieldData()->GetAbstractArray("region_names"));
  ASSERT_NE(names, nullptr);
  std::string lines;
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i) {
    lines += static_cast<char>(names->GetValue(i));
  }
  EXPECT_EQ(lines, "left\nright\n");
  EXPECT_EQ(grid_->GetCellData()->GetArray("region")->GetComponent(0, 0), 0);
  EXPECT_EQ(grid_->GetCellData()->GetArray("region")->GetComponent(
                static_cast<vtkIdType>(mesh_.num_elements()) - 1, 0),
            1);
}

/// VTK's own shape functions, at its parametric centre: a determinant that is not positive shows
/// nodes in an order that is not VTK's.
TEST_F(VtuRoundTrip, CellsHaveVtksNodeOrder) {
  ASSERT_EQ(grid_->GetNumberOfCells(), static_cast<vtkIdType>(mesh_.num_elements()));
  for (vtkIdType id = 0; id < grid_->GetNumberOfCells(); ++id) {
    vtkCell* cell = grid_->GetCell(id);
    double centre[3];
    cell->GetParametricCenter(centre);
    Eigen::Matrix3d jacobian;
    for (int c = 0; c < 3; ++c) {
      std::vector<double> coordinates(static_cast<std::size_t>(cell->GetNumberOfPoints()));
      for (vtkIdType p = 0; p < cell->GetNumberOfPoints(); ++p) {
        coordinates[static_cast<std::size_t>(p)] = cell->GetPoints()->GetPoint(p)[c];
      }
      double derivatives[3];
      // Derivatives of a position in physical space are the identity only through the inverse of
      // a right Jacobian, so a wrong order of nodes shows here, too.
      cell->Derivatives(0, centre, coordinates.data(), 1, derivatives);
      jacobian.row(c) << derivatives[0], derivatives[1], derivatives[2];
    }
    EXPECT_TRUE(jacobian.isApprox(Eigen::Matrix3d::Identity(), 1e-12))
        << "cell " << id << " of type " << cell->GetCellType() << "\n"
        << jacobian;
  }
}

/// Outward faces, as VTK defines them for its cells, give a positive volume.
TEST_F(VtuRoundTrip, CellsAreNotInsideOut) {
  for (vtkIdType id = 0; id < grid_->GetNumberOfCells(); ++id) {
    vtkCell* cell = grid_->GetCell(id);
    double volume = 0;
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
      vtkPoints* points = cell->GetFace(f)->GetPoints();
      const auto corner = [&](vtkIdType i) {
        return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(points->GetPoint(i)));
      };
      for (vtkIdType i = 1; i + 1 < points->GetNumberOfPoints(); ++i) {
        volume += corner(0).dot(corner(i).cross(corner(i + 1))) / 6;
      }
    }
    EXPECT_GT(volume, 0) << "cell " << id << " of type " << cell->GetCellType();
  }
}

/// The third node of each of VTK's quadratic edges lies between the other two.
TEST(Vtu, QuadraticCellsHaveVtksNodeOrder) {
  std::string scene = mixed_scene;
  const auto replace = [&](const std::string& from, const std::string& to) {
    scene.replace(scene.find(from), from.size(), to);
  };
  replace("stvk-hexa8-q8-none", "stvk-hexa20-q8-none");
  replace("stvk-tet4-q1-none", "stvk-tet10-q4-none");
  const Mesh mesh = make_mesh(read_text(scene)).mesh;
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "result.vtu";
  write_vtu(file, mesh, {});
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  int checked = 0;
  for (vtkIdType id = 0; id < grid->GetNumberOfCells(); ++id) {
    vtkCell* cell = grid->GetCell(id);
    if (cell->IsLinear() != 0) continue;
    for (int edge = 0; edge < cell->GetNumberOfEdges(); ++edge) {
      vtkPoints* points = cell->GetEdge(edge)->GetPoints();
      ASSERT_EQ(points->GetNumberOfPoints(), 3);
      const auto at = [&](vtkIdType i) {
        return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(points->GetPoint(i)));
      };
      EXPECT_TRUE(at(2).isApprox((at(0) + at(1)) / 2, 1e-12)) << "cell " << id << " edge " << edge;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 12 + 6 * 6);
}

TEST(Vtu, RejectsAFieldOfTheWrongSize) {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(read_text(mixed_scene)).mesh;
  const std::vector<double> short_field(3);
  EXPECT_THROW(write_vtu(folder.path() / "a.vtu", mesh, {{{"u", short_field}}, {}, {}}),
               InternalError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Vtu, SaysWhenItCannotWrite) {
  const TemporaryFolder folder;
  const std::filesystem::path file = write_file(folder, "file", "no folder");
  const Mesh mesh = make_mesh(read_text(mixed_scene)).mesh;
  EXPECT_THROW(write_vtu(file / "a.vtu", mesh, {}), WorkError);
}

}  // namespace
}  // namespace elastogen::selector
