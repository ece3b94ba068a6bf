#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "runtime/constraints.h"
#include "runtime/error.h"
#include "runtime/loads.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

TEST(Constraints, ImposeAndProject) {
  Constraints c(3, 3);
  EXPECT_EQ(c.num_free(), 9u);
  c.fix(0);
  c.fix(1, 2);
  c.prescribe(2, 0, 0.5);
  c.prescribe(2, 0, 0.5);  // the same again is no conflict
  EXPECT_EQ(c.num_constrained(), 5u);
  Vector u = Vector::Ones(9);
  c.impose(u);
  EXPECT_EQ(u, (Vector(9) << 0, 0, 0, 1, 1, 0, 0.5, 1, 1).finished());
  c.project(u);
  EXPECT_EQ(u, (Vector(9) << 0, 0, 0, 1, 1, 0, 0, 1, 1).finished());
  Vector v = Vector::Ones(9);
  c.project_constrained(v);
  EXPECT_EQ(v, (Vector(9) << 1, 1, 1, 0, 0, 1, 1, 0, 0).finished());
}

TEST(Constraints, RefuseWhatCannotBe) {
  Constraints c(3, 3);
  EXPECT_THROW(c.fix(3), InputError);
  EXPECT_THROW(c.fix(0, 3), InputError);
  EXPECT_THROW(c.prescribe(0, 0, std::nan("")), InputError);
  c.fix(1);
  try {
    c.prescribe(1, 2, 0.25);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("node 1: component 2"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("0 and 0.25"), std::string::npos) << error.what();
  }
}

// One tetrahedron of volume 1/6: each node carries a quarter of its weight.
TEST(Loads, GravityIsAConsistentBodyLoad) {
  Mesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.region_names = {"tet"};
  mesh.blocks.push_back({"tet4", 4, {0, 1, 2, 3}, {0}});
  const auto table = ReferenceKernels<Tet4, 1, false>::table();
  const Model model(mesh, one_part(mesh, table, 24));
  Vector f = Vector::Ones(12);
  add_gravity(model, std::array{0.0, 1.0, -10.0}, f);
  for (Eigen::Index a = 0; a < 4; ++a) {
    EXPECT_DOUBLE_EQ(f[3 * a], 1);
    EXPECT_DOUBLE_EQ(f[3 * a + 1], 2);
    EXPECT_DOUBLE_EQ(f[3 * a + 2], -9);
  }
  EXPECT_THROW(add_gravity(model, std::array{0.0, 1.0}, f), InputError);
  EXPECT_THROW(add_gravity(model, std::array{0.0, 1.0, HUGE_VAL}, f), InputError);
}

TEST(Loads, NodalForcesAddUp) {
  Vector f = Vector::Zero(6);
  add_nodal_force(1, std::array{1.0, 2.0, 3.0}, f);
  add_nodal_force(1, std::array{1.0, 0.0, 0.0}, f);
  EXPECT_EQ(f, (Vector(6) << 0, 0, 0, 2, 2, 3).finished());
  EXPECT_THROW(add_nodal_force(2, std::array{1.0, 0.0, 0.0}, f), InputError);
  EXPECT_THROW(add_nodal_force(0, std::array{std::nan(""), 0.0, 0.0}, f), InputError);
}

}  // namespace
}  // namespace elastogen::test
