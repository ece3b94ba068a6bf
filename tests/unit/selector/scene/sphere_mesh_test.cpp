// Thick spheres: their volume, surface, and that the elements fit each other.
#include "selector/scene/sphere_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

#include "element_measures.h"
#include "runtime/error.h"
#include "selector/io/mesh_faces.h"

namespace elastogen::selector {
namespace {

SphereDescription sphere(const std::string& element, int along, int layers) {
  SphereDescription description;
  description.inner = 1;
  description.outer = 2;
  description.cells = {along, layers};
  description.association.element = element;
  description.region = "sphere";
  return description;
}

class Sphere : public testing::TestWithParam<const char*> {};

TEST_P(Sphere, IsFilledByElementsThatFit) {
  const double exact = 7 * std::numbers::pi / 6;  // (8 - 1) 4/3 pi / 8
  double missing_before = 0;
  for (const int cells : {2, 4, 8}) {
    const SceneMesh made = make_sphere(sphere(GetParam(), cells, cells));
    const Mesh& mesh = made.mesh;
    double volume = 0;
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      const auto count = static_cast<std::size_t>(mesh.blocks[0].nodes_per_element);
      const double part = volume_by_faces(
          mesh.positions, std::span(mesh.blocks[0].nodes).subspan(e * count, count), GetParam());
      EXPECT_GT(part, 0) << e;
      volume += part;
    }
    const double missing = exact - volume;
    EXPECT_GT(missing, 0);
    // Faceted surfaces are short of the sphere by a part that falls with the square of their size.
    if (cells > 2) {
      EXPECT_NEAR(missing_before / missing, 4, 0.8) << cells;
    }
    missing_before = missing;

    // Inside there is no surface: boundary faces are those of the sphere and of three planes.
    const FaceMatching matching = match_faces(mesh);
    EXPECT_TRUE(matching.split_quadrilaterals.empty());
    std::size_t curved = 0;
    for (const MeshFace& face : matching.boundary) {
      bool on_plane = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bool all = true;
        for (const std::int32_t node : face.nodes) {
          all = all && mesh.positions[3 * static_cast<std::size_t>(node) + axis] == 0;
        }
        on_plane = on_plane || all;
      }
      curved += on_plane ? 0 : 1;
    }
    ASSERT_EQ(made.boundaries.size(), 2u);
    EXPECT_EQ(curved, made.boundaries[0].faces.size() + made.boundaries[1].faces.size());
    for (int surface = 0; surface < 2; ++surface) {
      for (const std::int32_t node : made.boundaries[static_cast<std::size_t>(surface)].nodes) {
        const double* x = mesh.positions.data() + 3 * node;
        EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), surface + 1, 1e-14);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Sphere, testing::Values("hexa8", "prism6", "pyramid5", "tet4"),
                         [](const auto& element) { return std::string(element.param); });

TEST(SphereMesh, SaysWhatItCannotBeCutInto) {
  try {
    (void)make_sphere(sphere("quad4", 2, 2));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be cut into 'quad4'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace elastogen::selector
