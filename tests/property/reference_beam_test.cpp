// Pure beams against independent solvers on the same meshes.
//
// Beam 8 x 1 x 1 m, clamped at x = 0, E = 100 MPa, nu = 0, rho = 1000 kg/m^3, gravity 9.81 m/s^2
// along -z as consistent body load, Saint-Venant Kirchhoff, static. Mean displacement of the end
// face by CalculiX 2.20 (C3D8, C3D4, NLGEOM) and FEniCSx 0.5, which agree to 6 digits; of quadratic
// elements by CalculiX (C3D10, C3D20R).
#include <gtest/gtest.h>

#include <cmath>

#include "bars.h"
#include "runtime/loads.h"
#include "runtime/newton.h"

namespace elastogen::test {
namespace {

struct Reference {
  const char* name;
  const char* association;
  std::array<int, 3> cells;
  double uz, ux;
};

class ReferenceBeam : public ::testing::TestWithParam<Reference> {};

TEST_P(ReferenceBeam, EndFaceAgreesToFiveDigits) {
  const Reference& reference = GetParam();
  const std::vector<std::string> associations{reference.association};
  const Mesh mesh = make_bar_mesh({8, 1, 1}, reference.cells, associations);
  Model model(mesh, parts_of(mesh, associations, 100e6, 0.0, 1000.0), ModelOptions{});
  Constraints constraints(mesh.num_nodes(), 3);
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    if (mesh.positions[3 * a] == 0.0) constraints.fix(a);
  }
  Vector load = Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
  const std::array<double, 3> gravity{0.0, 0.0, -9.81};
  add_gravity(model, gravity, load);
  Vector u = Vector::Zero(load.size());
  NewtonOptions options;
  options.linear_solver.kind = LinearSolverKind::conjugate_gradient;
  const NewtonResult result = solve_static(model, constraints, load, options, u);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;

  double uz = 0, ux = 0;
  int count = 0;
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    if (mesh.positions[3 * a] < 8.0 - 1e-9) continue;
    ux += u[static_cast<Eigen::Index>(3 * a)];
    uz += u[static_cast<Eigen::Index>(3 * a) + 2];
    ++count;
  }
  EXPECT_NEAR(uz / count, reference.uz, 1e-5 * std::abs(reference.uz));
  EXPECT_NEAR(ux / count, reference.ux, 1e-4 * std::abs(reference.ux));  // given to 6 decimals
}

#ifdef ELASTOGEN_CATALOGUE
// As scenes of the program these are run by default: PureBeam in tests/scene/run_test.cpp.
INSTANTIATE_TEST_SUITE_P(
    Fine, ReferenceBeam,
    ::testing::Values(Reference{"hexa8_48", "stvk-hexa8-q8-none", {48, 8, 8}, -0.599316, -0.025606},
                      Reference{"tet4_48", "stvk-tet4-q1-none", {48, 8, 8}, -0.567049, -0.022921}),
    [](const auto& info) { return info.param.name; });
#endif

INSTANTIATE_TEST_SUITE_P(
    Meshes, ReferenceBeam,
    ::testing::Values(
        Reference{"hexa8_24", "stvk-hexa8-q8-none", {24, 4, 4}, -0.575799, -0.023634},
        Reference{"tet10_12", "stvk-tet10-q4-none", {12, 2, 2}, -0.6072477, -0.0262999},
        Reference{"hexa20_12", "stvk-hexa20-q8-none", {12, 2, 2}, -0.6074932, -0.0263147}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace elastogen::test
