#include "runtime/project_semidefinite.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace elastogen {

bool project_semidefinite(Eigen::Ref<Eigen::MatrixXd> matrix) {
  // Rigid motions make every element's stiffness singular: a little is added for them.
  constexpr double singular = 1e-10;
  const double largest = matrix.diagonal().cwiseAbs().maxCoeff();
  if (largest == 0 && matrix.isZero(0)) return false;
  Eigen::MatrixXd shifted = matrix;
  shifted.diagonal().array() += singular * largest;
  if (Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(shifted).info() == Eigen::Success) return false;

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(matrix);
  const Eigen::MatrixXd& vectors = spectrum.eigenvectors();
  matrix = vectors * spectrum.eigenvalues().cwiseAbs().asDiagonal() * vectors.transpose();
  return true;
}

}  // namespace elastogen
