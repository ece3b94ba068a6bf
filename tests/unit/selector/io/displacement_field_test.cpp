#include "selector/io/displacement_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scene/temporary_scene.h"
#include "selector/io/pvd.h"
#include "selector/io/vtu.h"
#include "selector/scene/scene_mesh.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

/// Writes a displacement of a mesh: u_i = c_i + sum_j A_ij x_j.
std::vector<double> linear_field(const std::vector<double>& positions) {
  std::vector<double> values;
  for (std::size_t p = 0; p < positions.size(); p += 3) {
    const double x = positions[p], y = positions[p + 1], z = positions[p + 2];
    values.insert(values.end(), {0.1 + x - 2 * y, 0.5 * z, x + y + z});
  }
  return values;
}

class DisplacementField : public testing::Test {
 protected:
  void SetUp() override {
    const Mesh mesh = make_mesh(read_text(good_scene)).mesh;
    const std::vector<double> values = linear_field(mesh.positions);
    write_vtu(file_, mesh, {{{"displacement", values}}, {}, {}});
    write_vtu(bare_, mesh, {});
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "field.vtu", bare_ = folder_.path() / "bare.vtu";
};

TEST_F(DisplacementField, IsInterpolatedInsideCellsAndOnTheirFaces) {
  const std::vector<double> points = {0, 0, 0, 2, 1, 1, 1, 0.5, 0.25, 0.3, 0.7, 0.1};
  const std::vector<double> found = displacements_at(file_, points, 3);
  const std::vector<double> expected = linear_field(points);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

// Straight quadratic elements interpolate quadratic fields exactly.
TEST_F(DisplacementField, IsInterpolatedInQuadraticCells) {
  for (const char* association : {"stvk-hexa20-q8-none", "stvk-tet10-q4-none"}) {
    SCOPED_TRACE(association);
    const Mesh mesh =
        make_mesh(read_text(replaced(good_scene, "stvk-hexa8-q8-none", association))).mesh;
    const auto field = [](const std::vector<double>& positions) {
      std::vector<double> values = linear_field(positions);
      for (std::size_t p = 0; p < positions.size(); p += 3) {
        values[p] += positions[p] * positions[p] - positions[p + 1] * positions[p + 2];
      }
      return values;
    };
    const std::vector<double> values = field(mesh.positions);
    write_vtu(file_, mesh, {{{"displacement", values}}, {}, {}});
    const std::vector<double> points = {0, 0, 0, 2, 1, 1, 1, 0.5, 0.25, 0.3, 0.7, 0.1};
    const std::vector<double> found = displacements_at(file_, points, 3);
    const std::vector<double> expected = field(points);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
  }
}

TEST_F(DisplacementField, RefusesPointsOutsideAndOtherFiles) {
  EXPECT_THROW((void)displacements_at(file_, std::vector<double>{2.1, 0, 0}, 3), InputError);
  EXPECT_THROW((void)displacements_at(bare_, std::vector<double>{0, 0, 0}, 3), InputError);
  write_text_file(bare_, "no VTU");
  EXPECT_THROW((void)displacements_at(bare_, std::vector<double>{0, 0, 0}, 3), InputError);
}

TEST_F(DisplacementField, DistanceIsThatOfVectors) {
  const std::vector<double> a = {3, 0, 0, 0}, b = {0, 4, 0, 1};
  const FieldDistance distance = field_distance(a, b, 2);
  EXPECT_EQ(distance.maximum, 5);
  EXPECT_EQ(distance.minimum, 1);
  EXPECT_EQ(distance.mean, 3);
}

TEST_F(DisplacementField, SeriesNamesItsFilesWithTheirTimes) {
  write_pvd(folder_.path() / "series.pvd", {{0, "a.vtu"}, {0.1, "b.vtu"}});
  const std::string text = read_text_file(folder_.path() / "series.pvd", "index");
  EXPECT_NE(text.find("timestep=\"0.1\" group=\"\" part=\"0\" file=\"b.vtu\""), std::string::npos);
}

}  // namespace
}  // namespace elastogen::selector
