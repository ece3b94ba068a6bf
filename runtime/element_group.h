// Elements computed by the same kernels, in batches of lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/aligned_vector.h"
#include "runtime/element_status.h"
#include "runtime/error.h"
#include "runtime/kernel_abi.h"
#include "runtime/mesh.h"
#include "runtime/nodal_pass.h"

namespace elastogen {

/// Elements of one part and one geometry variant, in the kernels' precision.
///
/// Layout, with L = lanes, n = nodes of the element, d = dim:
///   elements   [batch * L + lane]                     element number in the mesh
///   dofs       [(batch * n + a) * L + lane]           d * node: first degree of freedom, in the
///                                                     numbers of passes (node_numbering.h)
///   shape      [batch]                                set of positions and constants that all
///   lanes
///                                                     of the batch share (congruent_elements.h);
///                                                     empty: every batch has a set of its own
///   turn       [batch * L + lane]                     which of node_orders the element's nodes
///   stand
///                                                     in; empty: all in their own
///   positions  [((set * n + a) * d + i) * L + lane]   of node a from node 0 of its element, which
///                                                     kernels cannot tell from the place itself;
///                                                     empty unless they read them
///   constants  [(set * num_constants + k) * L + lane] empty where at rest
///   state      [(batch * num_state + k) * L + lane]   empty unless the product is two-stage
/// Full batches take lane l's elements from the l-th L-th of a block of elements, so that the lanes
/// of a batch share few nodes and an addition seldom waits for the one before it. The last batch
/// repeats its last element in the empty lanes.
template <class Scalar>
struct ElementGroup {
  std::size_t part = 0;
  std::size_t block = 0;
  /// All nodes of all its elements are held where they are: no energy, no forces, no pass.
  bool at_rest = false;
  const KernelTable<Scalar>* table = nullptr;
  const VariantTable<Scalar>* kernels = nullptr;
  int dim = 3;
  int num_nodes = 0;
  int lanes = 1;
  double density = 0;
  std::size_t num_elements = 0;
  std::size_t num_batches = 0;
  std::size_t num_sets = 0;  ///< of positions and constants
  AlignedVector<Scalar> parameters;
  std::vector<std::int32_t> elements;
  AlignedVector<std::int32_t> dofs;
  std::vector<std::int32_t> shape;
  /// [order][a]: which node of an element stands at place a, of the orders that occur; at most the
  /// 24 that a box can be turned to. Empty: every element has its own order.
  std::vector<std::vector<int>> node_orders;
  std::vector<std::uint8_t> turn;
  AlignedVector<Scalar> positions;
  AlignedVector<Scalar> constants;
  AlignedVector<Scalar> state;
  std::shared_ptr<const MeshNumbers> numbers;  ///< the mesh's

  /// Lanes of a batch that hold an element of their own.
  [[nodiscard]] int used_lanes(std::size_t batch) const {
    const std::size_t l = static_cast<std::size_t>(lanes);
    return batch + 1 < num_batches ? lanes : static_cast<int>(num_elements - batch * l);
  }
  /// Values of one batch that hold one number per element and degree of freedom.
  [[nodiscard]] std::size_t values_per_batch() const {
    return static_cast<std::size_t>(num_nodes * dim * lanes);
  }
  [[nodiscard]] std::size_t bytes_per_element() const;

  /// The batch's set of positions and constants.
  [[nodiscard]] std::size_t set_of(std::size_t batch) const {
    return shape.empty() ? batch : static_cast<std::size_t>(shape[batch]);
  }
  /// Arguments for a kernel on one batch: positions, parameters, constants, state.
  [[nodiscard]] KernelArguments<Scalar> arguments(std::size_t batch) const {
    return arguments_of_set(set_of(batch), batch);
  }
  [[nodiscard]] KernelArguments<Scalar> arguments_of_set(std::size_t set, std::size_t batch) const;

  /// What a pass over all its batches needs to know of the group.
  [[nodiscard]] NodalPass<Scalar> nodal_pass() const;
};

/// Where a group's elements come from.
template <class Scalar>
struct ElementGroupSource {
  std::size_t part = 0;
  std::size_t block = 0;
  std::size_t first_element = 0;  ///< mesh number of the block's element 0
  bool at_rest = false;
  std::span<const std::int32_t> elements;  ///< indices within the block
  /// [k * num_nodes + a]: which node of the k-th element stands at place a; empty: their own order.
  std::span<const int> node_order;
  /// [batch]: the elements stand in the order of batches, all full and each of one rest shape.
  /// Empty: they are put into batches.
  std::span<const std::int32_t> shape;
  const KernelTable<Scalar>* table = nullptr;
  const VariantTable<Scalar>* kernels = nullptr;
  std::span<const double> parameters;
  double density = 0;
};

/// Batches the elements; positions are filled, constants and state are left empty.
template <class Scalar>
[[nodiscard]] ElementGroup<Scalar> make_element_group(const Mesh& mesh,
                                                      const ElementGroupSource<Scalar>& source);

/// Computes the grouped constants of all sets, unless at rest; drops positions that no kernel reads
/// later.
template <class Scalar>
void compute_constants(ElementGroup<Scalar>& group, int threads);

/// Layout known to the compiler, for tight loops over a batch.
template <class Scalar, int Dim, int Lanes>
struct BatchLayout {
  static constexpr int dim = Dim;
  static constexpr int lanes = Lanes;

  /// [(a * Dim + i) * Lanes + l], of global vectors as NodalPass has them.
  static void gather(const std::int32_t* dofs, int num_nodes, const double* u, Scalar* out) {
    kernel::gather_numbers<Scalar, Dim, Lanes>(dofs, num_nodes, u, out);
  }
};

/// Calls `function(BatchLayout<Scalar, dim, lanes>{})` with the group's layout.
/// Groups of another layout do not exist: Model refuses them.
template <class Scalar, int lanes = most_lanes<Scalar>, class Function>
void with_layout(const ElementGroup<Scalar>& group, Function&& function) {
  if constexpr (lanes > 1) {
    if (group.lanes < lanes) return with_layout<Scalar, lanes / 2>(group, function);
  }
  group.dim == 3 ? function(BatchLayout<Scalar, 3, lanes>{})
                 : function(BatchLayout<Scalar, 2, lanes>{});
}

/// First bad element of one batch, given its lanes' status flags.
template <class Scalar>
[[nodiscard]] ElementStatus batch_status(const ElementGroup<Scalar>& group, std::size_t batch,
                                         const std::uint32_t* flags);

}  // namespace elastogen
