// Model: energy, forces, product and stiffness with every kind of kernel.
#include "runtime/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

struct KernelCase {
  std::string name;
  std::string element;
  std::function<KernelTable<double>()> table;
};

template <class Element, int Lanes, bool FromPositions>
KernelCase kernel_case(const std::string& name) {
  return {name, Element::name,
          [] { return ReferenceKernels<Element, Lanes, FromPositions>::table(); }};
}

class ModelOfEachKernel : public testing::TestWithParam<KernelCase> {
 protected:
  void SetUp() override {
    table_ = GetParam().table();
    mesh_ = bar_mesh(GetParam().element, {3, 2, 3}, block_lengths);
    distort(mesh_, block_lengths, 0.05, 1);
  }
  [[nodiscard]] Model make(const ModelOptions& options = {.threads = 1}) const {
    return Model(mesh_, one_part(mesh_, table_), options);
  }
  [[nodiscard]] Vector forces(Model& model, const Vector& u) const {
    Vector f = Vector::Zero(u.size());
    model.forces(u, f);
    return f;
  }
  KernelTable<double> table_;
  Mesh mesh_;
};

TEST_P(ModelOfEachKernel, MatchesUniformStrainEnergyAndIsInBalanceInside) {
  Model model = make();
  Matrix3 h;
  h << 0.1, 0.02, -0.03, 0.05, -0.04, 0.01, 0.02, 0.03, 0.06;
  Vector u(static_cast<Eigen::Index>(model.num_dofs()));
  for (std::size_t node = 0; node < model.num_nodes(); ++node) {
    u.segment<3>(static_cast<Eigen::Index>(3 * node)) =
        h * Eigen::Map<const Vector3>(mesh_.positions.data() + 3 * node);
  }
  const Matrix3 e = (h + h.transpose() + h.transpose() * h) / 2;
  const std::vector<double> lame = lame_parameters();
  const double density = lame[0] / 2 * e.trace() * e.trace() + lame[1] * e.squaredNorm();
  const double volume = block_lengths[0] * block_lengths[1] * block_lengths[2];
  EXPECT_NEAR(model.energy(u), density * volume, 1e-12 * density * volume);

  const Vector f = forces(model, u);
  const double scale = f.lpNorm<Eigen::Infinity>();
  EXPECT_GT(scale, 1.0);
  for (std::size_t node = 0; node < model.num_nodes(); ++node) {
    bool inner = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = mesh_.positions[3 * node + i];
      inner = inner && x > 1e-9 && x < block_lengths[i] - 1e-9;
    }
    if (!inner) continue;
    EXPECT_LT(f.segment<3>(static_cast<Eigen::Index>(3 * node)).norm(), 1e-12 * scale) << node;
  }
}

TEST_P(ModelOfEachKernel, RigidMotionIsForceFree) {
  Model model = make();
  const Matrix3 rotation =
      Eigen::AngleAxisd(1.1, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  Vector u(static_cast<Eigen::Index>(model.num_dofs()));
  for (std::size_t node = 0; node < model.num_nodes(); ++node) {
    const Vector3 x = Eigen::Map<const Vector3>(mesh_.positions.data() + 3 * node);
    u.segment<3>(static_cast<Eigen::Index>(3 * node)) = rotation * x - x + Vector3(3, -1, 2);
  }
  const double stiffness = lame_parameters()[1];
  EXPECT_LT(forces(model, u).lpNorm<Eigen::Infinity>(), 1e-12 * stiffness);
  EXPECT_LT(std::abs(model.energy(u)), 1e-20 * stiffness);
}

// The remainder of a first-order expansion must fall by 4 when the step is halved.
TEST_P(ModelOfEachKernel, ForcesAreTheEnergysSlopeAndTheProductTheirs) {
  Model model = make();
  const Vector u = random_vector(model.num_dofs(), 0.03, 2);
  const Vector v = random_vector(model.num_dofs(), 1, 3);
  const double w = model.energy(u);
  const Vector f = forces(model, u);
  model.linearize(u);
  Vector df = Vector::Zero(u.size());
  model.product(v, 1, df);
  double energy_remainder = 0;
  double force_remainder = 0;
  for (const double h : {2e-3, 1e-3}) {
    const double energy = std::abs(model.energy(u + h * v) - w + h * f.dot(v));
    const double force = (forces(model, u + h * v) - f - h * df).norm();
    if (h < 2e-3) {
      EXPECT_NEAR(energy_remainder / energy, 4, 0.2);
      EXPECT_NEAR(force_remainder / force, 4, 0.2);
    }
    energy_remainder = energy;
    force_remainder = force;
  }
  EXPECT_TRUE(model.status().ok());
}

TEST_P(ModelOfEachKernel, AssembledMatrixAndDiagonalBlocksAgreeWithTheProduct) {
  Model model = make();
  const Vector u = random_vector(model.num_dofs(), 0.03, 4);
  const Vector v = random_vector(model.num_dofs(), 1, 5);
  model.linearize(u);
  Vector df = Vector::Zero(u.size());
  model.product(v, 1, df);
  Eigen::SparseMatrix<double> k;
  model.assemble(k);
  EXPECT_LT((k * v + df).norm(), 1e-12 * df.norm());
  EXPECT_LT((Eigen::SparseMatrix<double>(k.transpose()) - k).norm(), 1e-13 * k.norm());

  std::vector<double> blocks;
  model.diagonal_blocks(blocks);
  const double scale = k.diagonal().lpNorm<Eigen::Infinity>();
  for (Eigen::Index node = 0; node < u.size() / 3; ++node) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        const double block = blocks[static_cast<std::size_t>((node * 3 + i) * 3 + j)];
        EXPECT_NEAR(block, k.coeff(3 * node + i, 3 * node + j), 1e-13 * scale);
      }
    }
  }
}

TEST_P(ModelOfEachKernel, AssemblesInPlaceTheSecondTime) {
  Model model = make();
  Eigen::SparseMatrix<double> k;
  model.assemble(k);
  const Eigen::SparseMatrix<double> at_rest = k;
  const double* values = k.valuePtr();
  model.linearize(random_vector(model.num_dofs(), 0.03, 6));
  model.assemble(k);
  EXPECT_GT((k - at_rest).norm(), 1e-3 * k.norm());
  model.linearize(Vector::Zero(static_cast<Eigen::Index>(model.num_dofs())));
  model.assemble(k);
  EXPECT_EQ(values, k.valuePtr());
  EXPECT_EQ((k - at_rest).norm(), 0.0);
}

TEST_P(ModelOfEachKernel, StrategiesOfTheProductAgree) {
  const Vector v = random_vector(3 * mesh_.num_nodes(), 1, 7);
  const Vector u = random_vector(3 * mesh_.num_nodes(), 0.03, 8);
  Vector products[3];
  for (const TangentProduct strategy :
       {TangentProduct::recompute, TangentProduct::two_stage, TangentProduct::assembled}) {
    Model model = make({.threads = 1, .tangent_product = strategy});
    model.linearize(u);
    Vector& p = products[static_cast<int>(strategy)];
    p = Vector::Ones(v.size());
    model.product(v, -2, p);
    EXPECT_LT((p - products[0]).norm(), 1e-12 * products[0].norm());
    // Forces elsewhere leave the linearisation point alone.
    static_cast<void>(forces(model, 2 * u));
    Vector again = Vector::Ones(v.size());
    model.product(v, -2, again);
    EXPECT_EQ(p, again);
  }
}

TEST_P(ModelOfEachKernel, SemidefiniteTangentHasNoNegativeDirection) {
  const Vector v = random_vector(3 * mesh_.num_nodes(), 1, 7);
  // Crushed: the exact tangent has negative directions.
  Vector u = random_vector(3 * mesh_.num_nodes(), 0.01, 8);
  for (std::size_t node = 0; node < mesh_.num_nodes(); ++node) {
    u[static_cast<Eigen::Index>(3 * node)] -= 0.45 * mesh_.positions[3 * node];
  }
  Model model = make({.threads = 2});
  const auto least_curvature = [](const Eigen::SparseMatrix<double>& k) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(Eigen::MatrixXd{k});
    return spectrum.eigenvalues()[0] / spectrum.eigenvalues()[k.rows() - 1];
  };
  Eigen::SparseMatrix<double> k;
  model.linearize(u);
  model.assemble(k);
  const bool hardens = least_curvature(k) > -1e-12;  // a linear law does
  const Eigen::SparseMatrix<double> exact = k;
  model.linearize(u, TangentForm::semidefinite);
  model.assemble(k);
  EXPECT_GT(least_curvature(k), -1e-12);
  EXPECT_EQ((k - exact).norm() == 0, hardens);

  // Product and diagonal blocks are those of the same matrix.
  Vector p = Vector::Ones(v.size());
  model.product(v, -2, p);
  EXPECT_LT((p - Vector::Ones(v.size()) - 2 * (k * v)).norm(), 1e-13 * p.norm());
  std::vector<double> blocks;
  model.diagonal_blocks(blocks);
  for (Eigen::Index row = 0; row < k.rows(); ++row) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      EXPECT_EQ(blocks[static_cast<std::size_t>(3 * row + j)], k.coeff(row, row / 3 * 3 + j));
    }
  }
  model.linearize(u);
  model.assemble(k);
  EXPECT_EQ((k - exact).norm(), 0);
}

TEST_P(ModelOfEachKernel, ThreadsAgreeToRoundingAndRepeatBitForBit) {
  const Vector u = random_vector(3 * mesh_.num_nodes(), 0.03, 9);
  Model one = make({.threads = 1});
  const Vector f1 = forces(one, u);
  for (const int threads : {2, 3, 7}) {
    Model several = make({.threads = threads});
    const Vector f = forces(several, u);
    EXPECT_LT((f - f1).norm(), 1e-14 * f1.norm()) << threads;
    EXPECT_NEAR(several.energy(u), one.energy(u), 1e-14 * one.energy(u)) << threads;
    Eigen::SparseMatrix<double> k1;
    Eigen::SparseMatrix<double> k;
    one.assemble(k1);
    several.assemble(k);
    EXPECT_EQ((k - k1).norm(), 0.0) << threads;
    for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(forces(several, u), f) << threads;
  }
}

TEST_P(ModelOfEachKernel, ElementEnergiesAndVolumesAddUp) {
  Model model = make({.threads = 2});
  const Vector u = random_vector(model.num_dofs(), 0.03, 10);
  std::vector<double> energies;
  model.element_energies(u, energies);
  ASSERT_EQ(energies.size(), model.num_elements());
  double sum = 0;
  double volume = 0;
  double mass = 0;
  for (const double e : energies) sum += e;
  for (const double v : model.element_volumes()) volume += v;
  for (const double m : model.lumped_mass()) mass += m;
  EXPECT_NEAR(sum, model.energy(u), 1e-13 * sum);
  EXPECT_NEAR(volume, 3.0, 1e-13);
  EXPECT_NEAR(mass, 3000.0, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(, ModelOfEachKernel,
                         testing::Values(kernel_case<Tet4, 1, false>("tet4_scalar"),
                                         kernel_case<Tet4, 8, false>("tet4_batches"),
                                         kernel_case<Tet4, 8, true>("tet4_batches_from_positions"),
                                         kernel_case<Hexa8, 1, true>("hexa8_scalar_from_positions"),
                                         kernel_case<Hexa8, 8, false>("hexa8_batches")),
                         [](const testing::TestParamInfo<KernelCase>& info) {
                           return info.param.name;
                         });

}  // namespace
}  // namespace elastogen::test
