#include "runtime/stress_measures.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace elastogen {
namespace {

using Matrix = Eigen::Matrix3d;

Matrix symmetric_part(const Matrix& m) { return (m + m.transpose()) / 2; }

}  // namespace

SymmetricTensor symmetric_components(const Matrix& tensor) {
  const Matrix s = symmetric_part(tensor);
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

Matrix tensor_of(const SymmetricTensor& c) {
  Matrix tensor;
  tensor << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2];
  return tensor;
}

Matrix cauchy_stress(const PointStress& point, Kinematics kinematics) {
  if (kinematics == Kinematics::infinitesimal) return symmetric_part(point.first_piola);
  const Matrix f = Matrix::Identity() + point.gradient;
  return symmetric_part(point.first_piola * f.transpose()) / f.determinant();
}

Matrix second_piola_kirchhoff_stress(const PointStress& point, Kinematics kinematics) {
  if (kinematics == Kinematics::infinitesimal) return symmetric_part(point.first_piola);
  const Matrix f = Matrix::Identity() + point.gradient;
  return symmetric_part(f.inverse() * point.first_piola);
}

Matrix green_lagrange_strain(const PointStress& point, Kinematics kinematics) {
  const Matrix& h = point.gradient;
  if (kinematics == Kinematics::infinitesimal) return symmetric_part(h);
  return symmetric_part(h) + h.transpose() * h / 2;
}

Matrix logarithmic_strain(const PointStress& point, Kinematics kinematics) {
  const Matrix strain = green_lagrange_strain(point, kinematics);
  if (kinematics == Kinematics::infinitesimal) return strain;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(strain);
  const Eigen::Vector3d stretches =
      eigen.eigenvalues().unaryExpr([](double e) { return std::log1p(2 * e) / 2; });
  return eigen.eigenvectors() * stretches.asDiagonal() * eigen.eigenvectors().transpose();
}

double volume_ratio(const PointStress& point, Kinematics kinematics) {
  if (kinematics == Kinematics::infinitesimal) return 1 + point.gradient.trace();
  return (Matrix::Identity() + point.gradient).determinant();
}

double von_mises(const Matrix& stress) {
  const Matrix deviator = stress - stress.trace() / 3 * Matrix::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

PrincipalStress principal_stress(const Matrix& stress) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(stress);
  PrincipalStress result;
  for (int k = 0; k < 3; ++k) {
    result.values[k] = eigen.eigenvalues()[2 - k];
    Eigen::Vector3d direction = eigen.eigenvectors().col(2 - k);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    result.directions.col(k) = direction[largest] < 0 ? Eigen::Vector3d(-direction) : direction;
  }
  return result;
}

}  // namespace elastogen
