// A positive semi-definite matrix in the place of an element's stiffness.
#pragma once

#include <Eigen/Core>

namespace elastogen {

/// Replaces the eigenvalues of a symmetric matrix by their absolute values. One that a Cholesky
/// factorisation finds semi-definite up to 1e-10 of its largest diagonal entry is left as it is,
/// bit for bit: in most elements of a body most of the time.
///
/// Sums of semi-definite matrices are semi-definite, so an assembled stiffness becomes so element
/// by element. Where curvature is strongly negative, a step of that size is a better guess than the
/// boundless one of an eigenvalue set to 0 (J. Teran et al., Robust quasistatic finite elements and
/// flesh simulation, SCA 2005): bodies that start inside out, flattened or scrambled need a third
/// to a ninth of the Newton iterations, docs/stability.md. Source: H. Chen, H.-T. D. Liu, D. Levin,
/// C. Zheng & A. Jacobson, Stabler neo-Hookean simulation: absolute eigenvalue filtering for
/// projected Newton, SIGGRAPH 2024.
///
/// @param matrix  symmetric, finite; the lower triangle is read, the whole is written
/// @return whether it was changed
bool project_semidefinite(Eigen::Ref<Eigen::MatrixXd> matrix);

}  // namespace elastogen
