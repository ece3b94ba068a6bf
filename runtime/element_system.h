// The elements of a body in the precision of their kernels, over global vectors of doubles.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/element_pass.h"
#include "runtime/element_status.h"
#include "runtime/node_numbering.h"
#include "runtime/sleeping_regions.h"
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

/// What passes with nodal results did since the beginning.
struct PassCounts {
  std::int64_t passes = 0;
  std::int64_t slept = 0;       ///< elements whose forces were kept instead of computed, summed
  double seconds = 0;           ///< in passes
  double seconds_of_sleep = 0;  ///< finding out what sleeps, and adding its forces
};

/// How elements are divided among threads, and what sums their results.
struct PassPlan {
  template <class Scalar>
  PassPlan(const std::vector<ElementGroup<Scalar>>& groups, const std::vector<BatchRange>& batches,
           int threads, int max_values_per_node)
      : shares(plan_threads(groups, batches, threads)), accumulator(shares, max_values_per_node) {}

  std::vector<ThreadShare> shares;  // [thread]
  NodeAccumulator accumulator;
};

/// Runs the groups' kernels over all elements in threads. Every call but the constructor's returns
/// the first bad element; vectors are node-major as Model's, and their lengths are not checked.
template <class Scalar>
class ElementSystem {
 public:
  /// Computes grouped constants.
  /// @param threads    0: as many as OpenMP offers and the elements' work pays for
  /// @param two_stage  whether to keep room for the states of store_states()
  /// @param renumber   whether passes number nodes as the batches come to them
  ElementSystem(std::vector<ElementGroup<Scalar>> groups, std::size_t num_nodes, int dim,
                int threads, bool two_stage, bool renumber);

  [[nodiscard]] const std::vector<ElementGroup<Scalar>>& groups() const { return groups_; }
  [[nodiscard]] const NodeNumbering& numbering() const { return numbering_; }
  [[nodiscard]] const PassCounts& counts() const { return counts_; }
  [[nodiscard]] int num_threads() const { return threads_; }

  /// Lets regions sleep from now on (sleeping_regions.h): forces() computes what is awake.
  void let_sleep(double motion, int calls) {
    wake();
    sleeping_.emplace(groups_, dim_, motion, calls);
  }
  /// Lets them no more.
  void wake() {
    sleeping_.reset();
    awake_plan_.reset();
  }

  /// energy = W(u)
  ElementStatus energy(const double* u, double& energy);
  /// energies[element in the mesh]
  ElementStatus element_energies(const double* u, double* energies);
  /// f += -dW/dU at u
  ElementStatus forces(const double* u, double* f);
  /// Makes u, which is copied, the point of what follows; at first it is 0.
  void set_point(const double* u);
  /// df -= scale * K v
  ElementStatus product(const double* v, double scale, double* df);
  /// Keeps the states that apply() reads.
  ElementStatus store_states();
  /// df -= scale * K v with K where store_states() was called last.
  ElementStatus apply(const double* v, double scale, double* df);
  /// The matrix's pattern is made at the first call, and filled in place afterwards.
  ElementStatus assemble(TangentForm form, Eigen::SparseMatrix<double>& stiffness);
  /// Gives a matrix the pattern of assemble().
  void shape(Eigen::SparseMatrix<double>& stiffness) {
    stiffness_assembly().pattern().shape(stiffness);
  }
  /// blocks[(node * dim + i) * dim + j] += the block of K
  ElementStatus diagonal_blocks(double* blocks);

 private:
  void require(KernelFunction<Scalar> VariantTable<Scalar>::*kernel, const char* name) const;
  ElementStatus add_batches(const BatchRange& batches, const ElementPass<Scalar>& pass,
                            double scale, double* sum, std::int32_t first_dof,
                            Workspace<Scalar>& workspace);
  ElementStatus add_nodal(PassPlan& plan, const ElementPass<Scalar>& pass, double scale,
                          double* out);
  ElementStatus add_sleeping_forces(const ElementPass<Scalar>& pass, double* f);
  template <class Compute>
  void accumulate(PassPlan& plan, int values_per_node, double* out, Compute&& compute);
  [[nodiscard]] const double* for_passes(const double* vector);
  template <class Compute>
  ElementStatus for_each_share(Compute&& compute);
  template <class Consume>
  ElementStatus for_each_energy(const double* u, Consume&& consume);
  [[nodiscard]] ElementStatus merged_status() const;
  StiffnessAssembly<Scalar>& stiffness_assembly();

  std::size_t num_nodes_;
  int dim_;
  std::vector<ElementGroup<Scalar>> groups_;
  NodeNumbering numbering_;
  int threads_;
  AlignedVector<double> point_;        // in the numbers of passes; so the two
  AlignedVector<double> input_, sum_;  // that only renumbered passes need
  PassPlan plan_;
  std::vector<Workspace<Scalar>> workspaces_;          // [thread]
  std::vector<ElementStatus> statuses_;                // [thread]
  std::vector<CompensatedSum> sums_;                   // [thread]
  std::optional<StiffnessAssembly<Scalar>> assembly_;  // made when first needed
  std::optional<SleepingRegions> sleeping_;            // where allowed; so are the two below
  std::optional<PassPlan> awake_plan_;
  AlignedVector<double> kept_forces_;  // of all that sleeps, in the mesh's numbers
  PassCounts counts_;
};

}  // namespace elastogen
