// Models of the same body in double, mixed and single precision.
#include <gtest/gtest.h>

#include <random>

#include "bars.h"
#include "runtime/error.h"
#include "runtime/loads.h"
#include "runtime/newton.h"
#include "tested_kernels.h"

namespace elastogen::test {
namespace {

constexpr double single_epsilon = 1.2e-7;

const std::vector<std::string> associations = {"stvk-hexa8-q8-none", "neo_hookean-pyramid5-q5-none",
                                               "stvk-tet4-q1-auto"};

/// A bar whose inner nodes are moved: general hexahedra, pyramids, tetrahedra.
Mesh distorted_bar() {
  Mesh mesh = make_bar_mesh({2, 1, 1}, {6, 3, 3}, associations);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> shift(-0.03, 0.03);
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    const double y = mesh.positions[3 * a + 1], z = mesh.positions[3 * a + 2];
    if (y < 0.1 || y > 0.9 || z < 0.1 || z > 0.9) continue;
    for (std::size_t i = 0; i < 3; ++i) mesh.positions[3 * a + i] += shift(generator);
  }
  return mesh;
}

std::vector<ModelPart> parts_in_both(const Mesh& mesh) {
  std::vector<ModelPart> parts = parts_of(mesh, associations, 1e6, 0.3, 500);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    parts[p].single_kernels = kernels_of(associations[p]).float_table();
  }
  return parts;
}

Model make_model(const Mesh& mesh, Precision precision,
                 TangentProduct product = TangentProduct::recompute, int threads = 1) {
  ModelOptions options;
  options.precision = precision;
  options.tangent_product = product;
  options.threads = threads;
  return Model(mesh, parts_in_both(mesh), options);
}

Vector random_vector(const Model& model, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-size, size);
  Vector v(static_cast<Eigen::Index>(model.num_dofs()));
  for (double& value : v) value = random(generator);
  return v;
}

Vector forces(Model& model, const Vector& u) {
  Vector f = Vector::Zero(u.size());
  model.forces(u, f);
  EXPECT_TRUE(model.status().ok());
  return f;
}

Vector product(Model& model, const Vector& u, const Vector& v) {
  model.linearize(u);
  Vector p = Vector::Zero(u.size());
  model.product(v, 1, p);
  EXPECT_TRUE(model.status().ok());
  return p;
}

double relative(const Vector& value, const Vector& expected) {
  return (value - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

TEST(Precision, MixedHasEnergiesAndForcesOfDoubleAndTangentsOfSingle) {
  const Mesh mesh = distorted_bar();
  Model in_double = make_model(mesh, Precision::double_precision);
  Model mixed = make_model(mesh, Precision::mixed);
  const Vector u = random_vector(in_double, 0.02, 1), v = random_vector(in_double, 1, 2);
  EXPECT_EQ(mixed.energy(u), in_double.energy(u));
  EXPECT_EQ(forces(mixed, u), forces(in_double, u));
  EXPECT_EQ(mixed.epsilon(), in_double.epsilon());

  const Vector p = product(in_double, u, v);
  const double error = relative(product(mixed, u, v), p);
  EXPECT_GT(error, 1e-9) << "the product is not in single precision";
  EXPECT_LT(error, 8 * single_epsilon);

  Eigen::SparseMatrix<double> expected, stiffness;
  in_double.assemble(expected);
  mixed.assemble(stiffness);
  ASSERT_EQ(stiffness.nonZeros(), expected.nonZeros());
  EXPECT_LT((stiffness - expected).toDense().cwiseAbs().maxCoeff(),
            8 * single_epsilon * expected.toDense().cwiseAbs().maxCoeff());
  std::vector<double> blocks, expected_blocks;
  in_double.diagonal_blocks(expected_blocks);
  mixed.diagonal_blocks(blocks);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    EXPECT_NEAR(blocks[k], expected_blocks[k], 8 * single_epsilon * expected.coeffs().maxCoeff());
  }
}

TEST(Precision, SingleIsRightToItsRounding) {
  const Mesh mesh = distorted_bar();
  Model in_double = make_model(mesh, Precision::double_precision);
  Model single = make_model(mesh, Precision::single_precision);
  EXPECT_GT(single.epsilon(), 1e-7);
  for (const double size : {1e-8, 1e-4, 0.02}) {
    const Vector u = random_vector(in_double, size, 3), v = random_vector(in_double, 1, 4);
    const double energy = in_double.energy(u);
    EXPECT_NEAR(single.energy(u), energy, 8 * single_epsilon * energy) << size;
    EXPECT_LT(relative(forces(single, u), forces(in_double, u)), 8 * single_epsilon) << size;
    EXPECT_LT(relative(product(single, u, v), product(in_double, u, v)), 8 * single_epsilon);
  }
}

// The body's place and its motion as a whole are taken away before anything is rounded.
TEST(Precision, SingleIsNotHarmedByTranslations) {
  Mesh mesh = distorted_bar();
  Model near = make_model(mesh, Precision::single_precision);
  for (double& x : mesh.positions) x += 4096;
  Model far = make_model(mesh, Precision::single_precision);
  const Vector u = random_vector(near, 1e-3, 5);
  const Vector moved = u.array() + 1024;
  EXPECT_LT(relative(forces(far, moved), forces(near, u)), 8 * single_epsilon);
}

TEST(Precision, TangentStrategiesAgreeInSinglePrecision) {
  const Mesh mesh = distorted_bar();
  for (const Precision precision : {Precision::mixed, Precision::single_precision}) {
    Model recompute = make_model(mesh, precision);
    const Vector u = random_vector(recompute, 0.02, 6), v = random_vector(recompute, 1, 7);
    const Vector expected = product(recompute, u, v);
    for (const TangentProduct how : {TangentProduct::two_stage, TangentProduct::assembled}) {
      Model model = make_model(mesh, precision, how, 2);
      EXPECT_LT(relative(product(model, u, v), expected), 8 * single_epsilon);
    }
    Model projected = make_model(mesh, precision);
    projected.linearize(u, TangentForm::semidefinite);
    Vector p = Vector::Zero(u.size());
    projected.product(v, 1, p);
    EXPECT_LT(v.dot(p), 0);
  }
}

NewtonResult bend(Precision precision, double tolerance, LinearSolverKind kind, Vector& u) {
  const Mesh mesh = distorted_bar();
  Model model = make_model(mesh, precision);
  Constraints constraints(mesh.num_nodes(), 3);
  for (std::size_t a = 0; a < mesh.num_nodes(); ++a) {
    if (mesh.positions[3 * a] < 1e-9) constraints.fix(a);
  }
  u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  Vector load = u;
  add_gravity(model, std::array{0.0, 0.0, -9.81}, load);
  NewtonOptions options;
  options.tolerance = tolerance;
  options.linear_solver.kind = kind;
  return solve_static(model, constraints, load, options, u);
}

class NewtonPrecision : public testing::TestWithParam<LinearSolverKind> {};

TEST_P(NewtonPrecision, MixedComesToTheEndOfDouble) {
  Vector expected, u;
  ASSERT_EQ(bend(Precision::double_precision, 1e-11, GetParam(), expected).status,
            NewtonStatus::converged);
  const NewtonResult result = bend(Precision::mixed, 1e-11, GetParam(), u);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_LT(relative(u, expected), 1e-9);
}

TEST_P(NewtonPrecision, SingleReachesWhatItsRoundingAllowsAndSaysSo) {
  Vector expected, u;
  ASSERT_EQ(bend(Precision::double_precision, 1e-10, GetParam(), expected).status,
            NewtonStatus::converged);
  NewtonResult result = bend(Precision::single_precision, 1e-4, GetParam(), u);
  ASSERT_EQ(result.status, NewtonStatus::converged) << result.reason;
  EXPECT_LT(relative(u, expected), 1e-3);

  result = bend(Precision::single_precision, 1e-10, GetParam(), u);
  EXPECT_EQ(result.status, NewtonStatus::converged_to_rounding) << result.reason;
  EXPECT_GT(result.relative_residual, 1e-10);
  EXPECT_LT(result.relative_residual, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Solvers, NewtonPrecision,
                         testing::Values(LinearSolverKind::conjugate_gradient,
                                         LinearSolverKind::cholesky),
                         [](const auto& info) {
                           return info.param == LinearSolverKind::cholesky ? "Cholesky" : "Cg";
                         });

TEST(Precision, NeedsKernelsOfTheSameAssociationInBoth) {
  const Mesh mesh = distorted_bar();
  ModelOptions options;
  options.precision = Precision::mixed;
  std::vector<ModelPart> parts = parts_in_both(mesh);
  parts[1].single_kernels = nullptr;
  EXPECT_THROW(Model(mesh, parts, options), InternalError);
  parts[1].single_kernels = parts[0].single_kernels;
  EXPECT_THROW(Model(mesh, parts, options), InternalError);
}

}  // namespace
}  // namespace elastogen::test
