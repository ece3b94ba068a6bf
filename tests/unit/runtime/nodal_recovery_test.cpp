// From points to nodes: what must come through unchanged, and what must stay apart.
#include "runtime/nodal_recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "runtime/error.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

struct Body {
  explicit Body(const std::string& element)
      : table(element == "tet4" ? ReferenceKernels<Tet4, 4, false>::table()
                                : ReferenceKernels<Hexa8, 4, false>::table()),
        mesh(bar_mesh(element, {4, 3, 3}, block_lengths)) {
    distort(mesh, block_lengths, 0.06, 7);
  }
  /// The half x > block_lengths[0] / 2 as a part of its own.
  [[nodiscard]] std::vector<ModelPart> two_parts() const {
    std::vector<ModelPart> parts(2, one_part(mesh, table).front());
    for (ModelPart& part : parts) part.elements.clear();
    const auto count = static_cast<std::int32_t>(mesh.num_elements());
    for (std::int32_t e = 0; e < count; ++e) {
      parts[e < count / 2 ? 0 : 1].elements.push_back(e);
    }
    return parts;
  }
  KernelTable<double> table;
  Mesh mesh;
};

Vector3 position(std::span<const double> positions, std::size_t k) {
  return Eigen::Map<const Vector3>(positions.data() + 3 * k);
}

double linear(const Vector3& x) { return 3 + 2 * x[0] - 5 * x[1] + 7 * x[2]; }

/// [point * 2 + k]: a linear function of the rest position, and a constant.
std::vector<double> linear_and_constant(const NodalRecovery& recovery) {
  const std::vector<double> at = recovery.point_positions();
  std::vector<double> values;
  for (std::size_t p = 0; p < at.size() / 3; ++p) {
    values.insert(values.end(), {linear(position(at, p)), 4.0});
  }
  return values;
}

TEST(NodalRecovery, LeavesLinearFieldsAsTheyAreOnDistortedMeshes) {
  const Body body("hexa8");
  const std::vector<ModelPart> parts = one_part(body.mesh, body.table);
  NodalRecovery recovery(body.mesh, parts, std::vector<int>{0});
  ASSERT_EQ(recovery.num_slots(), body.mesh.num_nodes());
  const std::vector<double> points = linear_and_constant(recovery);
  for (const bool project : {false, true}) {
    const std::vector<double> slots =
        project ? recovery.project(points, 2) : recovery.average(points, 2);
    const std::vector<double> nodes = recovery.joined(slots, 2);
    for (std::size_t n = 0; n < body.mesh.num_nodes(); ++n) {
      // The projection's system is solved to 1e-12 of its right side; M's condition is about 100.
      EXPECT_NEAR(nodes[2 * n], linear(position(body.mesh.positions, n)), 1e-9) << project;
      EXPECT_NEAR(nodes[2 * n + 1], 4, 4e-10) << project;
    }
  }
}

TEST(NodalRecovery, LeavesAConstantWhereElementsHaveOnePoint) {
  const Body body("tet4");
  NodalRecovery recovery(body.mesh, one_part(body.mesh, body.table), std::vector<int>{0});
  const std::vector<double> points(body.mesh.num_elements(), 4.0);
  for (const double value : recovery.average(points, 1)) EXPECT_NEAR(value, 4, 1e-14);
  for (const double value : recovery.project(points, 1)) EXPECT_NEAR(value, 4, 4e-10);
}

// The projection's integral over the body is that of the points: its test functions sum up to 1.
TEST(NodalRecovery, KeepsTheIntegral) {
  const Body body("tet4");
  Model model(body.mesh, one_part(body.mesh, body.table), {.threads = 1});
  NodalRecovery recovery(body.mesh, one_part(body.mesh, body.table), std::vector<int>{0});
  const Vector random = random_vector(body.mesh.num_elements(), 1, 8);
  const std::vector<double> points(random.begin(), random.end());
  double expected = 0, found = 0;
  for (std::size_t e = 0; e < points.size(); ++e)
    expected += points[e] * model.element_volumes()[e];
  const std::vector<double> nodes = recovery.joined(recovery.project(points, 1), 1);
  for (std::size_t n = 0; n < nodes.size(); ++n) found += nodes[n] * model.nodal_volumes()[n];
  EXPECT_NEAR(found, expected, 1e-11);
}

TEST(NodalRecovery, DoesNotGoBeyondAZone) {
  const Body body("hexa8");
  const std::vector<ModelPart> parts = body.two_parts();
  NodalRecovery recovery(body.mesh, parts, std::vector<int>{0, 1});
  const std::size_t shared = 16;  // nodes at the interface
  ASSERT_EQ(recovery.num_slots(), body.mesh.num_nodes() + shared);
  std::vector<double> points(8 * body.mesh.num_elements(), 1.0);
  std::fill(points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2), points.end(), 100.0);
  for (const bool project : {false, true}) {
    const std::vector<double> slots =
        project ? recovery.project(points, 1) : recovery.average(points, 1);
    for (std::size_t e = 0; e < body.mesh.num_elements(); ++e) {
      for (const std::int32_t slot : recovery.element_slots(e)) {
        EXPECT_NEAR(slots[static_cast<std::size_t>(slot)],
                    e < body.mesh.num_elements() / 2 ? 1 : 100, 1e-8);
      }
    }
    std::size_t between = 0;
    for (const double value : recovery.joined(slots, 1)) between += value > 2 && value < 99;
    EXPECT_EQ(between, shared);
  }
  const NodalRecovery one_zone(body.mesh, parts, std::vector<int>{0, 0});
  EXPECT_EQ(one_zone.num_slots(), body.mesh.num_nodes());
}

TEST(NodalRecovery, PassesOnWhatIsNoNumberWithoutSolvingForIt) {
  const Body body("tet4");
  NodalRecovery recovery(body.mesh, one_part(body.mesh, body.table), std::vector<int>{0});
  std::vector<double> points(body.mesh.num_elements(), 4.0);
  points[0] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> nodes = recovery.average(points, 1);
  EXPECT_EQ(std::count_if(nodes.begin(), nodes.end(), [](double v) { return std::isnan(v); }), 4);
  EXPECT_TRUE(std::isnan(recovery.project(points, 1).back()));
}

TEST(NodalRecovery, ProjectsZonesBesideOneThatHasNoNumbers) {
  const Body body("hexa8");
  NodalRecovery recovery(body.mesh, body.two_parts(), std::vector<int>{0, 1});
  std::vector<double> points(8 * body.mesh.num_elements(), 4.0);
  points[0] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> slots = recovery.project(points, 1);
  for (std::size_t e = 0; e < body.mesh.num_elements(); ++e) {
    for (const std::int32_t slot : recovery.element_slots(e)) {
      const double value = slots[static_cast<std::size_t>(slot)];
      if (e < body.mesh.num_elements() / 2) {
        EXPECT_TRUE(std::isnan(value));
      } else {
        EXPECT_NEAR(value, 4, 4e-10);  // the system is solved to 1e-12; M's condition is about 100
      }
    }
  }
}

TEST(NodalRecovery, NeedsToKnowThePoints) {
  Body body("tet4");
  body.table.points = {};
  EXPECT_THROW(NodalRecovery(body.mesh, one_part(body.mesh, body.table), std::vector<int>{0}),
               InternalError);
}

}  // namespace
}  // namespace elastogen::test
