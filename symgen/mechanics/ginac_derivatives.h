// Forces and derivative-vector products by GiNaC: the path beside dag/differentiate, and its check.
#pragma once

#include <memory>
#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/mechanics/energy.h"

namespace elastogen::symgen {

/// A term of the nodal sum for a displacement gradient in reference coordinates:
///   D_ik = sum over the differences of coordinate k of c (U_node,i - U_other,i).
struct Difference {
  int node, other;
};

/// Derivatives of an energy by nodal displacements.
struct NodalDerivatives {
  std::vector<NodeId> forces, product;  ///< [a * dim + i]
};

/// What one quadrature point puts in the places of the general expressions.
struct PointValues {
  std::vector<NodeId> parameters, displacement, direction;
  std::vector<std::vector<NodeId>> coefficients;      ///< c of differences[k][p], as [k][p]
  std::vector<std::vector<NodeId>> inverse_jacobian;  ///< [k][j] = d xi_k / d X_j
  NodeId measure;                                     ///< weight times Jacobian determinant
};

/// The energy of an element at one quadrature point, written in GiNaC in the displacements of its
/// nodes with all definitions put in, and its derivatives as GiNaC takes them:
///   W_l = measure * W_l(H),  H_ij = sum_k D_ik d xi_k / d X_j       (thesis eq. 3.22, 3.40)
///   f_ai = -dW_l/dU_ai                                              (thesis eq. 3.30)
///   p_ai = sum_bj (df_ai/dU_bj) V_bj, as df_ai(U + e V)/de at e = 0  (thesis eq. 3.34)
/// All quadrature points have these expressions in common, so they are derived once and lowered
/// once; `at_point` puts a point's values in.
class GinacDerivatives {
 public:
  /// @param differences  [reference coordinate]
  /// @param numbers      the pool of the graphs that `at_point` will write to
  GinacDerivatives(const Law& law, const EnergyDensity& energy, int num_nodes,
                   const std::vector<std::vector<Difference>>& differences,
                   std::shared_ptr<NumberPool> numbers);

  /// Derivatives of law term `l` in `target`.
  [[nodiscard]] NodalDerivatives at_point(Dag& target, std::size_t l,
                                          const PointValues& values) const;

 private:
  Dag dag_;
  std::vector<NodeId> inputs_;           // in the order of flat(PointValues)
  std::vector<NodalDerivatives> terms_;  // [law term]
};

}  // namespace elastogen::symgen
