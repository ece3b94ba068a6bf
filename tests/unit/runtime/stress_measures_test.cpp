// Stresses and strains at a point against closed forms.
#include "runtime/stress_measures.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace elastogen::test {
namespace {

using Matrix = Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double mu = 3e5, lambda = 5e5;

/// Neo-Hooke's P = mu (F - F^-T) + lambda ln J F^-T (Bonet & Wood, eq. 6.28).
PointStress neo_hookean(const Matrix& h) {
  const Matrix f = Matrix::Identity() + h;
  const Matrix inverse = f.inverse().transpose();
  return {h, mu * (f - inverse) + lambda * std::log(f.determinant()) * inverse, 0, 1};
}

Matrix random_rotation(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

Matrix random_gradient(unsigned seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  return Matrix::NullaryExpr([&] { return uniform(random); });
}

TEST(StressMeasures, OfUniaxialStretch) {
  const double stretch = 1.6, across = 0.85;
  const Matrix h = Vector3d(stretch - 1, across - 1, across - 1).asDiagonal();
  const PointStress point = neo_hookean(h);
  const double p = point.first_piola(0, 0);
  const Matrix sigma = cauchy_stress(point, Kinematics::finite);
  EXPECT_NEAR(sigma(0, 0), p / (across * across), 1e-15 * p);
  EXPECT_NEAR(second_piola_kirchhoff_stress(point, Kinematics::finite)(0, 0), p / stretch,
              1e-15 * p);
  EXPECT_DOUBLE_EQ(green_lagrange_strain(point, Kinematics::finite)(0, 0),
                   (stretch * stretch - 1) / 2);
  const Matrix hencky = logarithmic_strain(point, Kinematics::finite);
  EXPECT_NEAR(hencky(0, 0), std::log(stretch), 2e-16);
  EXPECT_NEAR(hencky(1, 1), std::log(across), 2e-16);
  EXPECT_NEAR(volume_ratio(point, Kinematics::finite), stretch * across * across, 3e-16);
  EXPECT_NEAR(von_mises(sigma), std::abs(sigma(0, 0) - sigma(1, 1)), 1e-15 * p);
}

// Simple shear by gamma: J = 1, E_xy = gamma / 2, E_yy = gamma^2 / 2; neo-Hooke's Cauchy stress is
// mu (B - I), its principal values mu (m^2 - 1), 0, mu (1/m^2 - 1) with m - 1/m = gamma, and the
// logarithmic strain has the principal values ln m, 0, -ln m.
TEST(StressMeasures, OfSimpleShear) {
  const double gamma = 0.7, m = gamma / 2 + std::sqrt(1 + gamma * gamma / 4);
  Matrix h = Matrix::Zero();
  h(0, 1) = gamma;
  const PointStress point = neo_hookean(h);
  const Matrix sigma = cauchy_stress(point, Kinematics::finite);
  const SymmetricTensor expected = {mu * gamma * gamma, 0, 0, mu * gamma, 0, 0};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(symmetric_components(sigma)[k], expected[k], 1e-15 * mu) << symmetric_names[k];
  }
  const Matrix strain = green_lagrange_strain(point, Kinematics::finite);
  EXPECT_DOUBLE_EQ(strain(0, 1), gamma / 2);
  EXPECT_DOUBLE_EQ(strain(1, 1), gamma * gamma / 2);
  const PrincipalStress principal = principal_stress(sigma);
  EXPECT_NEAR(principal.values[0], mu * (m * m - 1), 2e-15 * mu);
  EXPECT_NEAR(principal.values[1], 0, 2e-15 * mu);
  EXPECT_NEAR(principal.values[2], mu * (1 / (m * m) - 1), 2e-15 * mu);
  EXPECT_LT(
      (sigma * principal.directions - principal.directions * principal.values.asDiagonal()).norm(),
      4e-15 * mu);
  const Eigen::SelfAdjointEigenSolver<Matrix> hencky(logarithmic_strain(point, Kinematics::finite));
  EXPECT_NEAR(hencky.eigenvalues()[0], -std::log(m), 1e-15);
  EXPECT_NEAR(hencky.eigenvalues()[2], std::log(m), 1e-15);
  // Of a Cauchy stress alone: pure shear tau has sqrt(3) tau.
  Matrix shear = Matrix::Zero();
  shear(0, 1) = shear(1, 0) = 4;
  EXPECT_NEAR(von_mises(shear), std::sqrt(3.0) * 4, 1e-14);
}

TEST(StressMeasures, StrainsAndInvariantsDoNotSeeRotations) {
  const Matrix h = random_gradient(1, 0.4), r = random_rotation(2);
  const Matrix turned = r * (Matrix::Identity() + h) - Matrix::Identity();
  const PointStress a = neo_hookean(h), b = neo_hookean(turned);
  const auto same = [](const Matrix& x, const Matrix& y) { return (x - y).norm() / x.norm(); };
  constexpr auto finite = Kinematics::finite;
  EXPECT_LT(same(green_lagrange_strain(a, finite), green_lagrange_strain(b, finite)), 1e-14);
  EXPECT_LT(same(logarithmic_strain(a, finite), logarithmic_strain(b, finite)), 1e-14);
  EXPECT_LT(
      same(second_piola_kirchhoff_stress(a, finite), second_piola_kirchhoff_stress(b, finite)),
      1e-14);
  EXPECT_LT(same(r * cauchy_stress(a, finite) * r.transpose(), cauchy_stress(b, finite)), 1e-14);
  EXPECT_NEAR(von_mises(cauchy_stress(b, finite)) / von_mises(cauchy_stress(a, finite)), 1, 1e-14);
  // sigma = F S F^T / J
  const Matrix f = Matrix::Identity() + h;
  EXPECT_LT(same(cauchy_stress(a, finite) * f.determinant(),
                 f * second_piola_kirchhoff_stress(a, finite) * f.transpose()),
            1e-14);
}

TEST(StressMeasures, PureRotationHasNoStrain) {
  const PointStress point{random_rotation(3) - Matrix::Identity(), Matrix::Zero(), 0, 1};
  // What rounding of the rotation's nine numbers makes.
  EXPECT_LT(logarithmic_strain(point, Kinematics::finite).norm(), 4e-15);
  EXPECT_LT(green_lagrange_strain(point, Kinematics::finite).norm(), 4e-15);
}

// All digits of strains that 1 + strain would lose: to second order ln U = sym H + ...
TEST(StressMeasures, KeepTheDigitsOfSmallStrains) {
  for (const double size : {1e-6, 1e-10, 1e-200}) {
    const Matrix h = random_gradient(4, size);
    const PointStress point{h, Matrix::Zero(), 0, 1};
    const Matrix e = green_lagrange_strain(point, Kinematics::finite);
    const Matrix expected = e - e * e;  // ln(1 + 2 e) / 2 = e - e^2 + ...
    EXPECT_LT((logarithmic_strain(point, Kinematics::finite) - expected).norm(),
              4 * (1e-15 + size * size) * size);
    EXPECT_LE((expected - (h + h.transpose()) / 2).norm(), 20 * size * size);
  }
}

TEST(StressMeasures, OfLawsForSmallDisplacementsAreOneStressAndOneStrain) {
  const Matrix h = random_gradient(5, 0.3), strain = (h + h.transpose()) / 2;
  const PointStress point{h, lambda * strain.trace() * Matrix::Identity() + 2 * mu * strain, 0, 1};
  constexpr auto small = Kinematics::infinitesimal;
  EXPECT_EQ(cauchy_stress(point, small), point.first_piola);
  EXPECT_EQ(second_piola_kirchhoff_stress(point, small), point.first_piola);
  EXPECT_EQ(green_lagrange_strain(point, small), strain);
  EXPECT_EQ(logarithmic_strain(point, small), strain);
  EXPECT_EQ(volume_ratio(point, small), 1 + h.trace());
}

TEST(StressMeasures, PrincipalDirectionsAreSortedAndOfOneSign) {
  const Matrix r = random_rotation(6);
  const Vector3d values(7, -2, -9);
  const PrincipalStress found = principal_stress(r * values.asDiagonal() * r.transpose());
  EXPECT_LT((found.values - values).norm(), 1e-13);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::abs(found.directions.col(k).dot(r.col(k))), 1, 1e-14);
    EXPECT_GT(found.directions.col(k).maxCoeff(), -found.directions.col(k).minCoeff());
  }
  EXPECT_EQ(tensor_of(symmetric_components(tensor_of({1, 2, 3, 4, 5, 6}))),
            tensor_of({1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace elastogen::test
