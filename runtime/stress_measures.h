// Stresses and strains that follow from the deformation and the first Piola-Kirchhoff stress at a
// point.
//
// With H = dU/dX, F = I + H, J = det F, C = F^T F, and P = dW/dH:
//
//   Cauchy stress                   sigma = P F^T / J   force per area as it is now
//   first Piola-Kirchhoff stress    P                   force now per area at rest; not symmetric
//   second Piola-Kirchhoff stress   S = F^-1 P          conjugate to E
//   Green-Lagrange strain           E = (C - I) / 2 = (H + H^T + H^T H) / 2
//   logarithmic (Hencky) strain     ln U = (ln C) / 2
//
// Source: Bonet & Wood, Nonlinear Continuum Mechanics, 2nd ed., sections 4.5, 4.6, 5.2 and 5.5;
// logarithmic strain: Hencky, Z. techn. Phys. 9 (1928) 215-220.
//
// Laws for small displacements only (Hooke) know neither turned nor stretched areas: to first order
// in H, which is as far as they go, all stresses are P, both strains the infinitesimal strain
// (H + H^T) / 2, and the volume ratio 1 + tr H (Bonet & Wood, section 4.10).
//
// In plane strain sigma_zz is part of all invariants.
#pragma once

#include <Eigen/Core>
#include <array>

#include "runtime/stress.h"

namespace elastogen {

/// What a law takes its displacement gradient for.
enum class Kinematics {
  finite,
  infinitesimal,  ///< laws for small displacements only
};

/// Components of a symmetric tensor in VTK's order, and their names.
inline constexpr int num_symmetric = 6;
inline constexpr std::array<const char*, num_symmetric> symmetric_names = {"XX", "YY", "ZZ",
                                                                           "XY", "YZ", "XZ"};
using SymmetricTensor = std::array<double, num_symmetric>;

/// All components of a tensor, row by row, and their names; of P the row is the force's direction,
/// the column that of the area's normal at rest.
inline constexpr std::array<const char*, 9> tensor_names = {"XX", "XY", "XZ", "YX", "YY",
                                                            "YZ", "ZX", "ZY", "ZZ"};

/// Of the symmetric part.
[[nodiscard]] SymmetricTensor symmetric_components(const Eigen::Matrix3d& tensor);
[[nodiscard]] Eigen::Matrix3d tensor_of(const SymmetricTensor& components);

/// Symmetric up to rounding, as laws are objective; it is infinite or no number where J = 0 [Pa].
[[nodiscard]] Eigen::Matrix3d cauchy_stress(const PointStress& point, Kinematics kinematics);
/// Likewise [Pa].
[[nodiscard]] Eigen::Matrix3d second_piola_kirchhoff_stress(const PointStress& point,
                                                            Kinematics kinematics);
[[nodiscard]] Eigen::Matrix3d green_lagrange_strain(const PointStress& point,
                                                    Kinematics kinematics);
/// From the eigenvalues of C - I, which keeps the digits of small strains. Those of ln U, whatever
/// the sign of J: the strain of an element turned inside out is that of its mirror image.
[[nodiscard]] Eigen::Matrix3d logarithmic_strain(const PointStress& point, Kinematics kinematics);
/// J, dimensionless; below 0 inside out.
[[nodiscard]] double volume_ratio(const PointStress& point, Kinematics kinematics);

/// Of a Cauchy stress: sqrt(3/2 s : s), s its deviator [Pa]. Source: von Mises, Goettinger
/// Nachrichten (1913) 582-592.
[[nodiscard]] double von_mises(const Eigen::Matrix3d& stress);

struct PrincipalStress {
  Eigen::Vector3d values;      ///< the greatest (most tensile) first [Pa]
  Eigen::Matrix3d directions;  ///< columns, of length 1; the greatest component is positive
};

/// Of a Cauchy stress.
[[nodiscard]] PrincipalStress principal_stress(const Eigen::Matrix3d& stress);

}  // namespace elastogen
