// The choice of a linear solver by what each would cost on a mesh.
#pragma once

#include <string>

#include "runtime/linear_solver.h"
#include "runtime/mesh.h"

namespace elastogen {

/// What the systems are for.
enum class SolverTask {
  equilibrium,    ///< a handful of tangents by Newton's method, ill-conditioned where slender
  implicit_step,  ///< one tangent per time step, with a mass that keeps the condition low
};

/// A body seen from its ends: layers of nodes, each joined by elements to the next only.
struct LayeredShape {
  double num_dofs = 0;
  double num_layers = 0;       ///< in nodes: twice the elements' number where these are quadratic
  double thickness = 0;        ///< nodes across a layer: its width's root, in the plane its width
  double multiplications = 0;  ///< of a Cholesky factorisation in a good order, about
  double factor_entries = 0;   ///< of its factor, about
  double product_operations = 0;  ///< of one product with the tangent, about
};

/// @param mesh  checked, as Model does
[[nodiscard]] LayeredShape layered_shape(const Mesh& mesh);

struct SolverChoice {
  LinearSolverKind kind = LinearSolverKind::conjugate_gradient;
  std::string reason;  ///< for people: what it was compared with
  /// LinearSolverOptions::fall_back_after: what would be many times the iterations expected; 0
  /// where a factor would not fit into the memory.
  int fall_back_after = 0;
  /// NewtonOptions::factorize_for_stability: where that costs a small part of the solve.
  bool factorize_for_stability = false;
};

/// The method that should take least time, by counts of operations: a function of mesh, task and
/// memory, not of a clock, so that equal runs choose alike. How the counts were fitted is told in
/// docs/decisions/0023-choosing-a-solver.md.
///
/// @param memory  that a factor may take [bytes]
[[nodiscard]] SolverChoice choose_linear_solver(const Mesh& mesh, SolverTask task, double memory);

/// Half of the machine's memory [bytes].
[[nodiscard]] double memory_for_factor();

}  // namespace elastogen
