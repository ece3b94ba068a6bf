// Pressure and traction on surfaces: by hand, in balance, and on a sphere that is refined.
#include "runtime/surface_loads.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "runtime/error.h"

namespace elastogen::test {
namespace {

using Vector3 = Eigen::Vector3d;

Vector3 node_values(const Vector& f, std::size_t node) {
  return f.segment<3>(static_cast<Eigen::Index>(3 * node));
}

Vector3 resultant(const Vector& f) {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index i = 0; i < f.size(); i += 3) sum += f.segment<3>(i);
  return sum;
}

Vector3 moment(const Mesh& mesh, const Vector& f) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    const Vector3 x = Eigen::Map<const Vector3>(&mesh.positions[3 * node]);
    sum += x.cross(node_values(f, node));
  }
  return sum;
}

/// A surface without a body: loads ask for no elements.
struct Surface {
  Mesh mesh;
  std::vector<SurfaceFace> faces;
};

/// The six sides of a cube [-1, 1]^3, each cut into n x n quadrilaterals, whose normals point
/// outwards; nodes of neighbouring sides are apart, which changes no resultant.
Surface cube_surface(int n) {
  Surface surface;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::int32_t>(surface.mesh.num_nodes());
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          std::array<double, 3> x{};
          x[axis] = side;
          x[(axis + 1) % 3] = -1 + 2.0 * i / n;
          x[(axis + 2) % 3] = -1 + 2.0 * j / n;
          surface.mesh.positions.insert(surface.mesh.positions.end(), x.begin(), x.end());
        }
      }
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const std::int32_t a = first + i * (n + 1) + j;
          SurfaceFace face = {a, a + n + 1, a + n + 2, a + 1};
          if (side < 0) face = {a, a + 1, a + n + 2, a + n + 1};
          surface.faces.push_back(face);
        }
      }
    }
  }
  return surface;
}

Vector zero_forces(const Mesh& mesh) {
  return Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
}

TEST(SurfaceLoads, PressurePushesAgainstAFlatFace) {
  Surface surface;
  surface.mesh.positions = {0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0, 5, 5, 5};
  surface.faces = {{0, 1, 2, 3}};  // its normal is +z
  Vector f = zero_forces(surface.mesh);
  add_pressure(surface.mesh, surface.faces, 10, f);
  for (std::size_t node = 0; node < 4; ++node) {
    EXPECT_LT((node_values(f, node) - Vector3(0, 0, -15)).norm(), 1e-13) << node;
  }
  EXPECT_EQ(node_values(f, 4), Vector3::Zero());
  EXPECT_DOUBLE_EQ(surface_area(surface.mesh, surface.faces), 6);

  surface.faces = {{0, 1, 2}};
  f.setZero();
  add_pressure(surface.mesh, surface.faces, 10, f);
  for (std::size_t node = 0; node < 3; ++node) {
    EXPECT_LT((node_values(f, node) - Vector3(0, 0, -10)).norm(), 1e-13) << node;
  }
}

TEST(SurfaceLoads, TractionIsForcePerArea) {
  Surface surface;
  surface.mesh.positions = {0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0};
  surface.faces = {{3, 2, 1, 0}};  // a traction does not ask for the direction of the face
  Vector f = Vector::Ones(12);
  add_traction(surface.mesh, surface.faces, std::array{1.0, -2.0, 3.0}, f);
  for (std::size_t node = 0; node < 4; ++node) {
    EXPECT_LT((node_values(f, node) - Vector3(1 + 1.5, 1 - 3.0, 1 + 4.5)).norm(), 1e-13);
  }
}

// Nodal forces of a linear traction on a trapezium differ: the consistent ones are the integrals of
// the shape functions, here by hand over [0, 1] x [0, 1 + x].
TEST(SurfaceLoads, ForcesAreIntegralsOfTheShapeFunctions) {
  Surface surface;
  surface.mesh.positions = {0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 1, 0};
  surface.faces = {{0, 1, 2, 3}};
  Vector f = zero_forces(surface.mesh);
  add_pressure(surface.mesh, surface.faces, -1, f);
  const double left = (1.0 / 2 + 1.0 / 6) / 2;   // integral of (1 - x)(1 + x) / 2
  const double right = (1.0 / 2 + 1.0 / 3) / 2;  // integral of x (1 + x) / 2
  EXPECT_NEAR(f[2], left, 1e-15);
  EXPECT_NEAR(f[5], right, 1e-15);
  EXPECT_NEAR(f[8], right, 1e-15);
  EXPECT_NEAR(f[11], left, 1e-15);
}

TEST(SurfaceLoads, PressureOnAClosedSurfaceIsInBalance) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-0.3, 0.3);
  // A hexahedron whose faces are warped quadrilaterals.
  Surface surface;
  surface.mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  for (double& x : surface.mesh.positions) x += random(generator);
  surface.faces = {{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5},
                   {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  Vector f = zero_forces(surface.mesh);
  add_pressure(surface.mesh, surface.faces, 7, f);
  EXPECT_GT(f.norm(), 1);
  EXPECT_LT(resultant(f).norm(), 1e-13 * f.norm());
  EXPECT_LT(moment(surface.mesh, f).norm(), 1e-13 * f.norm());
}

/// The faces with a node in the middle of every edge, shared between neighbours.
Surface quadratic(Surface surface) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  for (SurfaceFace& face : surface.faces) {
    const std::size_t corners = face.size();
    for (std::size_t c = 0; c < corners; ++c) {
      const auto [low, high] = std::minmax({face[c], face[(c + 1) % corners]});
      const auto next = static_cast<std::int32_t>(surface.mesh.num_nodes());
      const auto [middle, is_new] = middles.try_emplace({low, high}, next);
      face.push_back(middle->second);
      for (int i = 0; i < 3 && is_new; ++i) {
        const auto at = [&](std::int32_t node) {
          return surface.mesh.positions[static_cast<std::size_t>(3 * node + i)];
        };
        surface.mesh.positions.push_back((at(low) + at(high)) / 2);
      }
    }
  }
  return surface;
}

TEST(SurfaceLoads, ActOnFlatQuadraticFacesAsTheirShapeFunctionsSay) {
  Surface surface;
  surface.mesh.positions = {0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0};
  surface.faces = {{0, 1, 2, 3}};
  surface = quadratic(surface);
  Vector f = zero_forces(surface.mesh);
  add_pressure(surface.mesh, surface.faces, -12, f);
  // Serendipity: -1/12 of the force at each corner, 1/3 in the middle of each edge.
  for (std::size_t node = 0; node < 8; ++node) {
    const double force = node < 4 ? -6 : 24;
    EXPECT_LT((node_values(f, node) - Vector3(0, 0, force)).norm(), 1e-12) << node;
  }
  EXPECT_NEAR(surface_area(surface.mesh, surface.faces), 6, 1e-14);

  surface.mesh.positions = {0, 0, 0, 2, 0, 0, 2, 3, 0};
  surface.faces = {{0, 1, 2}};
  surface = quadratic(surface);
  f = zero_forces(surface.mesh);
  add_traction(surface.mesh, surface.faces, std::array{1.0, -2.0, 3.0}, f);
  for (std::size_t node = 0; node < 6; ++node) {  // nothing at corners, a third at each edge
    const Vector3 force = node < 3 ? Vector3::Zero().eval() : Vector3(1, -2, 3);
    EXPECT_LT((node_values(f, node) - force).norm(), 1e-14) << node;
  }
}

TEST(SurfaceLoads, PressureOnACurvedClosedSurfaceIsInBalance) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-0.2, 0.2);
  // A body of curved faces: four quadrilaterals, the other two sides each cut into two triangles.
  Surface surface;
  surface.mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  surface.faces = {{0, 3, 2},    {0, 2, 1},    {0, 1, 5, 4}, {1, 2, 6, 5},
                   {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6},    {4, 6, 7}};
  surface = quadratic(surface);
  for (double& x : surface.mesh.positions) x += random(generator);
  Vector f = zero_forces(surface.mesh);
  add_pressure(surface.mesh, surface.faces, 7, f);
  EXPECT_GT(f.norm(), 1);
  EXPECT_LT(resultant(f).norm(), 1e-13 * f.norm());
  EXPECT_LT(moment(surface.mesh, f).norm(), 1e-13 * f.norm());
}

// On a hemisphere the pressure's resultant is that on the disc below it.
TEST(SurfaceLoads, ResultantOnAHemisphereTendsToThatOnItsDisc) {
  constexpr double radius = 2, pressure = 3;
  const double exact = pressure * std::numbers::pi * radius * radius;
  double before = 0;
  for (const int n : {4, 8, 16}) {
    Surface surface = cube_surface(n);
    for (std::size_t node = 0; node < surface.mesh.num_nodes(); ++node) {
      Eigen::Map<Vector3> x(&surface.mesh.positions[3 * node]);
      x *= radius / x.norm();
    }
    std::erase_if(surface.faces, [&](const SurfaceFace& face) {
      double height = 0;
      for (const std::int32_t node : face) {
        height += surface.mesh.positions[3 * static_cast<std::size_t>(node) + 2];
      }
      return height < 0;
    });
    Vector f = zero_forces(surface.mesh);
    add_pressure(surface.mesh, surface.faces, pressure, f);
    const Vector3 force = resultant(f);
    EXPECT_LT(std::hypot(force[0], force[1]), 1e-13 * exact);
    const double error = std::abs(force[2] + exact);
    EXPECT_LT(error, 0.5 * exact / (n * n));
    if (before > 0) {
      EXPECT_LT(error, 0.27 * before) << "not of second order at " << n;
    }
    before = error;
  }
}

TEST(SurfaceLoads, ActOnEdgesOfPlaneBodies) {
  Mesh mesh;
  mesh.dim = 2;
  mesh.positions = {0, 0, 3, 4};
  const std::vector<SurfaceFace> faces = {{0, 1}};  // the body on its left: outward is (4, -3) / 5
  Vector f = Vector::Zero(4);
  add_pressure(mesh, faces, 2, f);
  EXPECT_LT((f - (Vector(4) << -4, 3, -4, 3).finished()).norm(), 1e-14);
  add_traction(mesh, faces, std::array{1.0, 0.0}, f);
  EXPECT_LT((f - (Vector(4) << -1.5, 3, -1.5, 3).finished()).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(surface_area(mesh, faces), 5);
}

TEST(SurfaceLoads, RefuseWhatCannotBe) {
  Surface surface = cube_surface(1);
  Vector f = zero_forces(surface.mesh);
  EXPECT_THROW(add_pressure(surface.mesh, surface.faces, std::nan(""), f), InputError);
  EXPECT_THROW(add_traction(surface.mesh, surface.faces, std::array{1.0, 2.0}, f), InputError);
  EXPECT_THROW(add_traction(surface.mesh, surface.faces, std::array{1.0, 2.0, HUGE_VAL}, f),
               InputError);
  const std::vector<SurfaceFace> outside = {{0, 1, 99}}, edge = {{0, 1}};
  EXPECT_THROW(add_pressure(surface.mesh, outside, 1, f), InputError);
  EXPECT_THROW(add_pressure(surface.mesh, edge, 1, f), InputError);
  EXPECT_EQ(f, zero_forces(surface.mesh));
}

}  // namespace
}  // namespace elastogen::test
