#include "selector/scene/model_warnings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

/// The material of the good scene, with another law.
Problem with_material(const std::string& association, const std::string& parameters) {
  return prepare_text(replaced(replaced(good_scene, "stvk-hexa8-q8-none", association),
                               "young = 1e6\npoisson = 0.3", parameters));
}

TEST(MaterialWarnings, AreNoneForASoundModel) {
  EXPECT_TRUE(material_warnings(prepare_text(good_scene)).empty());
  EXPECT_TRUE(material_warnings(with_material("yeoh-hexa20-q8-none",
                                              "c1 = 5e5\nc2 = -1e4\nc3 = 1e3\nkappa = 1e9"))
                  .empty());
}

TEST(MaterialWarnings, NameLinearElementsThatLock) {
  EXPECT_TRUE(material_warnings(with_material("stvk-hexa8-q8-none", "young = 1e6\npoisson = 0.49"))
                  .empty());
  EXPECT_TRUE(
      material_warnings(with_material("stvk-hexa20-q8-none", "young = 1e6\npoisson = 0.4999"))
          .empty());
  const std::vector<std::string> warnings =
      material_warnings(with_material("stvk-hexa8-q8-none", "young = 1e6\npoisson = 0.4999"));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0],
            "region 'body': law 'stvk' is nearly incompressible (nu = 0.4999 > 0.49), where the "
            "linear elements hexa8 lock: they bend and shear several times too little; take hexa20 "
            "or tet10 (docs/stability.md, which elements lock)");
}

// The material of Cook's membrane: mu = 80.194 MPa, kappa = 400.89 GPa.
TEST(MaterialWarnings, FindPoissonsRatioInTheLawsOwnParameters) {
  const TemporaryFolder folder;
  write_file(folder, "nh_iso.toml", R"toml(name = "nh_iso"
[[parameter]]
name = "mu"
unit = "Pa"
[[parameter]]
name = "kappa"
unit = "Pa"
[[term]]
name = "iso"
energy = "mu/2*(J^(-2/3)*I1 - 3)"
[[term]]
name = "vol"
energy = "kappa/2*((J^2 - 1)/2 - log(J))"
)toml");
  const std::string scene = R"toml(laws = ["nh_iso.toml"]
[bar]
length = 2.0
height = 1.0
cells = [2, 1]
[[bar.section]]
until = 0.5
association = "nh_iso-quad4-q4-none"
region = "left"
[[bar.section]]
until = 1.0
association = "nh_iso-tri3-q1-none"
region = "right"
[material.membrane]
regions = ["left", "right"]
density = 1000.0
mu = 80.194e6
kappa = 400.89e9
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y"]
)toml";
  const std::vector<std::string> warnings =
      material_warnings(prepare(read_scene(write_file(folder, "scene.toml", scene)), {}));
  ASSERT_EQ(warnings.size(), 1U) << "two regions of one material";
  expect_contains(warnings[0],
                  "regions 'left', 'right': law 'nh_iso' is nearly incompressible (nu = 0.4999 > "
                  "0.49), where the linear elements quad4, tri3 lock");
  expect_contains(warnings[0], "there are no quadratic plane elements");
}

TEST(MaterialWarnings, NameParametersThatAreUnstableAtRest) {
  const std::vector<std::string> warnings =
      material_warnings(with_material("stvk-hexa8-q8-none", "lambda = -1.0\nmu = 1.0"));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0],
            "region 'body': law 'stvk' is unstable at rest with lambda = -1, mu = 1: its shear "
            "modulus is 1 Pa and 3 lambda + 2 mu is -1 Pa, both must be > 0; mend the parameters");
}

TEST(MaterialWarnings, NameStretchesAtWhichMeasuredParametersAreUnstable) {
  const std::vector<std::string> warnings = material_warnings(
      with_material("yeoh-hexa20-q8-none", "c1 = 1e6\nc2 = -2e5\nc3 = 0.0\nkappa = 1e9"));
  ASSERT_EQ(warnings.size(), 1U);
  expect_contains(warnings[0],
                  "region 'body': law 'yeoh' with c1 = 1e+06, c2 = -200000, c3 = 0, kappa = 1e+09 "
                  "is unstable in uniaxial tension beyond a stretch of 1.");
  expect_contains(warnings[0], ", pure shear beyond a stretch of 1.");
}

/// Two elements of two points each.
StressField field_of(const std::array<Eigen::Matrix3d, 4>& gradients) {
  StressField field{{0, 2, 4}, {}};
  for (const Eigen::Matrix3d& gradient : gradients) {
    field.points.push_back({gradient, Eigen::Matrix3d::Zero(), 0, 0.25});
  }
  return field;
}

const Eigen::Matrix3d at_rest = Eigen::Matrix3d::Zero();

Eigen::Matrix3d stretched(double strain) {
  return Eigen::Vector3d(strain, -0.3 * strain, -0.3 * strain).asDiagonal();
}

Eigen::Matrix3d turned(double degrees) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -2) / 3;
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix() -
         Eigen::Matrix3d::Identity();
}

/// F = R U of both.
Eigen::Matrix3d turned_and_stretched(double degrees, double strain) {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  return (one + turned(degrees)) * (one + stretched(strain)) - one;
}

Problem hooke_problem() { return prepare_text(replaced(good_scene, "stvk-", "hooke-")); }

TEST(DeformationWarnings, AreNoneWhereAllIsSmall) {
  EXPECT_TRUE(deformation_warnings(hooke_problem(), field_of({at_rest, stretched(0.049),
                                                              stretched(-0.049), turned(4.9)}))
                  .empty());
}

TEST(DeformationWarnings, NameTheWorstElementOfALawForSmallStrain) {
  const std::vector<std::string> warnings = deformation_warnings(
      hooke_problem(),
      field_of({stretched(0.06), at_rest, at_rest, turned_and_stretched(20, -0.03)}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0],
            "law 'hooke' is for small displacements and rotations, but 2 of its 2 elements are "
            "strained by more than 5 % or turned by more than 5 degrees at the end, most of all "
            "element 1, by 3 % and 20 degrees: take stvk or neo_hookean");
}

TEST(DeformationWarnings, SpeakOfTheFilesElementNumbers) {
  Problem problem = hooke_problem();
  const std::vector<std::uint64_t> nodes(problem.mesh.mesh.num_nodes());
  problem.mesh.mesh.numbers = std::make_shared<MeshNumbers>(MeshNumbers{nodes, {1001, 1007}});
  const std::vector<std::string> warnings =
      deformation_warnings(problem, field_of({at_rest, at_rest, stretched(0.2), stretched(0.1)}));
  ASSERT_EQ(warnings.size(), 1U);
  expect_contains(warnings[0], "1 of its 2 elements");
  expect_contains(warnings[0], "element 1007, by 20 % and 0 degrees");
}

TEST(DeformationWarnings, LeaveLawsForLargeStrainAlone) {
  EXPECT_TRUE(deformation_warnings(prepare_text(good_scene),
                                   field_of({stretched(0.5), turned(90), at_rest, at_rest}))
                  .empty());
}

TEST(DeformationWarnings, NameElementsTurnedInsideOut) {
  const Eigen::Matrix3d flat = Eigen::Vector3d(0, 0, -1).asDiagonal();
  const Eigen::Matrix3d inverted = Eigen::Vector3d(0, -1.5, 0).asDiagonal();
  const Eigen::Matrix3d doubly = Eigen::Vector3d(0, -1.5, -1.5).asDiagonal();
  const Problem problem = prepare_text(good_scene);
  EXPECT_TRUE(deformation_warnings(problem, field_of({doubly, at_rest, at_rest, at_rest})).empty())
      << "two axes turned round make a rotation";
  const std::vector<std::string> one =
      deformation_warnings(problem, field_of({at_rest, at_rest, at_rest, inverted}));
  ASSERT_EQ(one.size(), 1U);
  expect_contains(one[0],
                  "1 of 2 elements is inside out at the end (det F <= 0 at a point), the "
                  "first is element 1");
  const std::vector<std::string> both =
      deformation_warnings(problem, field_of({at_rest, flat, inverted, inverted}));
  ASSERT_EQ(both.size(), 1U);
  expect_contains(both[0], "2 of 2 elements are inside out");
  expect_contains(both[0], "the first is element 0");
}

TEST(DeformationWarnings, MeasureAnInvertedElementAsStrained) {
  const Eigen::Matrix3d inverted = Eigen::Vector3d(0, -2, 0).asDiagonal();
  const std::vector<std::string> warnings =
      deformation_warnings(hooke_problem(), field_of({at_rest, at_rest, at_rest, inverted}));
  ASSERT_EQ(warnings.size(), 2U);
  expect_contains(warnings[1], "element 1, by 200 %");
}

}  // namespace
}  // namespace elastogen::selector
