// Stiffness of all elements into a sparse matrix.
#pragma once

#include <span>
#include <vector>

#include "runtime/block_pattern.h"
#include "runtime/element_pass.h"
#include "runtime/tangent.h"

namespace elastogen {

/// Fills the values of a matrix of the given pattern with K at `displacement`. Threads compute
/// element matrices of a few batches together, then each adds the columns of its own nodes in the
/// order of elements: the result does not depend on the number of threads.
template <class Scalar>
class StiffnessAssembly {
 public:
  StiffnessAssembly(const std::vector<ElementGroup<Scalar>>& groups, const NodeNumbering& numbering,
                    std::size_t num_nodes, int dim, int threads);

  [[nodiscard]] const BlockPattern& pattern() const { return pattern_; }

  /// @param displacement  in the groups' numbers
  /// @param form  semidefinite: of the elements' matrices projected one by one; those of bad
  ///              elements are left alone
  /// @return the first bad element
  ElementStatus run(const std::vector<ElementGroup<Scalar>>& groups, const double* displacement,
                    TangentForm form, double* values);

 private:
  template <class Layout>
  void add_columns(const ElementGroup<Scalar>& group, std::size_t group_number, std::size_t batch,
                   const Scalar* matrices, int thread, int num_threads, double* values) const;

  int threads_;
  BlockPattern pattern_;
  std::vector<Workspace<Scalar>> workspaces_;  // [thread]; output unused
  AlignedVector<Scalar> matrices_;             // of the batches that are computed together
};

}  // namespace elastogen
