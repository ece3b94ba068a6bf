// CalculiX as the independent solver beside which elastogen's times and errors stand.
//
// Its program `ccx` is optional (Debian: calculix-ccx); nothing of it is linked.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// A displacement [m] or a force [N] of one degree of freedom.
struct NodalValue {
  std::size_t node = 0;  ///< of the mesh, from 0
  int component = 0;     ///< 0: x, 1: y, 2: z
  double value = 0;
};

/// One static problem of one isotropic material.
struct CalculixProblem {
  const Mesh* mesh = nullptr;  ///< dim 3, one block; every node belongs to an element

  /// CalculiX's name: C3D4 (for blocks of tet4), C3D6 (prism6), C3D8, C3D8I, C3D8R (hexa8),
  /// C3D10 (tet10), C3D15 (prism15), C3D20, C3D20R (hexa20). Node orders are the same as ours;
  /// points of integration need not be (C3D6 has 2, C3D20R 8).
  std::string element_type;

  double young = 0;                 ///< [Pa]
  double poisson = 0;               ///< in (-1, 0.5)
  double density = 0;               ///< [kg/m^3]
  std::array<double, 3> gravity{};  ///< [m/s^2], enters as a consistent body load

  /// Displacements, zero ones too. With one step they rise linearly from 0. A path that is no
  /// straight line, such as a rotation, has several steps: each gives all prescribed degrees of
  /// freedom at its end, and loads rise in equal parts over the steps.
  std::vector<std::vector<NodalValue>> prescribed;

  std::vector<NodalValue> forces;  ///< dead loads; at most one per degree of freedom

  /// Green-Lagrange strain and second Piola-Kirchhoff stress (CalculiX: NLGEOM), which with a
  /// linear elastic material is Saint-Venant Kirchhoff; false: linear elasticity.
  bool large_deformation = false;

  int increments = 1;  ///< of each step, at least; CalculiX cuts those that do not converge

  /// Largest residual force over the mean force at which an iteration is converged. CalculiX's own
  /// default is 0.005; 0 leaves it.
  double tolerance = 0;

  std::string equation_solver;  ///< "SPOOLES", "ITERATIVE CHOLESKY" ...; empty: CalculiX's default
  int threads = 1;
  double time_limit = 0;  ///< wall seconds; 0: none
};

struct CalculixResult {
  /// [3 * node + component], metres. The .dat file has 7 digits, the most that CalculiX writes as
  /// text: errors below 1e-6 cannot be told.
  std::vector<double> displacement;
  double wall_seconds = 0;  ///< of the process: reading the deck, solving, writing displacements
  double cpu_seconds = 0;   ///< user and system time
  int iterations = 0;       ///< of Newton, all increments; 1 if linear
  std::string solver;       ///< of the linear systems, as CalculiX's output names it: "spooles"
};

[[nodiscard]] bool have_calculix();

/// "CalculiX 2.20", from `ccx -v`.
/// @throws WorkError  when it cannot be run
[[nodiscard]] std::string calculix_version();

/// The input deck. Numbers have 12 digits: CalculiX reads no more than 20 characters of each.
/// @throws InternalError  for a problem that is none: another block, a node that does not exist
[[nodiscard]] std::string calculix_deck(const CalculixProblem& problem);

/// Writes NAME.inp into the folder and lets ccx solve it there. The deck stays; what ccx wrote is
/// removed when it succeeded.
/// @throws WorkError  when ccx is missing, fails, is stopped or takes too long; with the end of
///                    its output
[[nodiscard]] CalculixResult run_calculix(const CalculixProblem& problem,
                                          const std::filesystem::path& folder,
                                          const std::string& name);

}  // namespace elastogen::selector
