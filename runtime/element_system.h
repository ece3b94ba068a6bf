// The elements of a body in the precision of their kernels, over global vectors of doubles.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/element_pass.h"
#include "runtime/element_status.h"
#include "runtime/stiffness_assembly.h"
#include "runtime/tangent.h"
#include "runtime/thread_plan.h"

namespace elastogen {

/// Sum whose error does not grow with the number of terms: the line search compares energies that
/// differ in their last digits. (Neumaier, ZAMM 54 (1974) 39-51.)
struct CompensatedSum {
  double sum = 0;
  double lost = 0;

  void add(double value);
  [[nodiscard]] double value() const { return sum + lost; }
};

/// Runs the groups' kernels over all elements in threads. Every call but the constructor's returns
/// the first bad element; vectors are node-major as Model's, and their lengths are not checked.
template <class Scalar>
class ElementSystem {
 public:
  /// Computes grouped constants.
  /// @param threads    0: as many as OpenMP offers and the elements' work pays for
  /// @param two_stage  whether to keep room for the states of store_states()
  ElementSystem(std::vector<ElementGroup<Scalar>> groups, std::size_t num_nodes, int dim,
                int threads, bool two_stage);

  [[nodiscard]] const std::vector<ElementGroup<Scalar>>& groups() const { return groups_; }
  [[nodiscard]] int num_threads() const { return threads_; }

  /// energy = W(u)
  ElementStatus energy(const double* u, double& energy);
  /// energies[element in the mesh]
  ElementStatus element_energies(const double* u, double* energies);
  /// f += -dW/dU at u
  ElementStatus forces(const double* u, double* f);
  /// Keeps the states about u that apply() reads.
  ElementStatus store_states(const double* u);
  /// df -= scale * K v with K at u
  ElementStatus product(const double* u, const double* v, double scale, double* df);
  /// The same with K where store_states() was called last.
  ElementStatus apply(const double* v, double scale, double* df);
  /// K at u. The matrix's pattern is made at the first call, and filled in place afterwards.
  ElementStatus assemble(const double* u, TangentForm form, Eigen::SparseMatrix<double>& stiffness);
  /// Gives a matrix the pattern of assemble().
  void shape(Eigen::SparseMatrix<double>& stiffness) {
    stiffness_assembly().pattern().shape(stiffness);
  }
  /// blocks[(node * dim + i) * dim + j] += the block of K at u
  ElementStatus diagonal_blocks(const double* u, double* blocks);

 private:
  void require(KernelFunction<Scalar> VariantTable<Scalar>::*kernel, const char* name) const;
  ElementStatus add_nodal(const ElementPass<Scalar>& pass, double scale, double* out);
  template <class Compute>
  ElementStatus for_each_share(Compute&& compute);
  template <class Consume>
  ElementStatus for_each_energy(const double* u, Consume&& consume);
  [[nodiscard]] ElementStatus merged_status() const;
  StiffnessAssembly<Scalar>& stiffness_assembly();

  std::size_t num_nodes_;
  int dim_;
  std::vector<ElementGroup<Scalar>> groups_;
  int threads_;
  std::vector<ThreadShare> shares_;            // [thread]
  std::vector<Workspace<Scalar>> workspaces_;  // [thread]
  std::vector<ElementStatus> statuses_;        // [thread]
  std::vector<CompensatedSum> sums_;           // [thread]
  NodeAccumulator accumulator_;
  std::optional<StiffnessAssembly<Scalar>> assembly_;  // made when first needed
};

}  // namespace elastogen
