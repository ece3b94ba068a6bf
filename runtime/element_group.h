// Elements computed by the same kernels, in batches of lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "runtime/aligned_vector.h"
#include "runtime/element_status.h"
#include "runtime/error.h"
#include "runtime/kernel_abi.h"
#include "runtime/mesh.h"

namespace elastogen {

/// Elements of one part and one geometry variant, in the kernels' precision.
///
/// Layout, with L = lanes, n = nodes of the element, d = dim:
///   elements   [batch * L + lane]                     element number in the mesh
///   dofs       [(batch * n + a) * L + lane]           d * node: first degree of freedom
///   positions  [((batch * n + a) * d + i) * L + lane] of node a from node 0 of its element, which
///                                                     kernels cannot tell from the place itself;
///                                                     empty unless they read them
///   constants  [(batch * num_constants + k) * L + lane]
///   state      [(batch * num_state + k) * L + lane]   empty unless the product is two-stage
/// Full batches take lane l's elements from the l-th L-th of the group, so that the lanes of a
/// batch share few nodes and a scatter seldom waits for the store before it. The last batch repeats
/// its last element in the empty lanes.
template <class Scalar>
struct ElementGroup {
  std::size_t part = 0;
  std::size_t block = 0;
  const KernelTable<Scalar>* table = nullptr;
  const VariantTable<Scalar>* kernels = nullptr;
  int dim = 3;
  int num_nodes = 0;
  int lanes = 1;
  double density = 0;
  std::size_t num_elements = 0;
  std::size_t num_batches = 0;
  AlignedVector<Scalar> parameters;
  std::vector<std::int32_t> elements;
  std::vector<std::int32_t> dofs;
  AlignedVector<Scalar> positions;
  AlignedVector<Scalar> constants;
  AlignedVector<Scalar> state;

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

  /// Arguments for a kernel on one batch: positions, parameters, constants, state.
  [[nodiscard]] KernelArguments<Scalar> arguments(std::size_t batch) const;
};

/// Where a group's elements come from.
template <class Scalar>
struct ElementGroupSource {
  std::size_t part = 0;
  std::size_t block = 0;
  std::size_t first_element = 0;           ///< mesh number of the block's element 0
  std::span<const std::int32_t> elements;  ///< indices within the block
  /// [k * num_nodes + a]: which node of the k-th element stands at place a; empty: their own order.
  std::span<const int> node_order;
  const KernelTable<Scalar>* table = nullptr;
  const VariantTable<Scalar>* kernels = nullptr;
  std::span<const double> parameters;
  double density = 0;
};

/// Batches the elements; positions are filled, constants and state are left empty.
template <class Scalar>
[[nodiscard]] ElementGroup<Scalar> make_element_group(const Mesh& mesh,
                                                      const ElementGroupSource<Scalar>& source);

/// Computes the grouped constants of all batches; drops positions that no kernel reads later.
template <class Scalar>
void compute_constants(ElementGroup<Scalar>& group, int threads);

/// Layout known to the compiler, for tight loops between global vectors, always of doubles, and a
/// batch's.
template <class Scalar, int Dim, int Lanes>
struct BatchLayout {
  static constexpr int dim = Dim;
  static constexpr int lanes = Lanes;

  /// out[(a * Dim + i) * Lanes + l] = u[dofs[a * Lanes + l] + i]; in single precision less the
  /// value of the element's node 0, so that its own motion is not lost in that of the body.
  static void gather(const std::int32_t* dofs, int num_nodes, const double* u, Scalar* out) {
    for (int a = 0; a < num_nodes; ++a) {
      for (int l = 0; l < Lanes; ++l) {
        const double* node = u + dofs[a * Lanes + l];
        for (int i = 0; i < Dim; ++i) {
          if constexpr (std::is_same_v<Scalar, double>) {
            out[(a * Dim + i) * Lanes + l] = node[i];
          } else {
            out[(a * Dim + i) * Lanes + l] = static_cast<Scalar>(node[i] - u[dofs[l] + i]);
          }
        }
      }
    }
  }

  /// f[dofs[a * Lanes + l] - offset + i] += value[(a * Dim + i) * Lanes + l], used lanes only
  static void scatter(const std::int32_t* dofs, int num_nodes, int used_lanes, const Scalar* value,
                      std::int32_t offset, double* f) {
    for (int a = 0; a < num_nodes; ++a) {
      for (int l = 0; l < used_lanes; ++l) {
        double* node = f + (dofs[a * Lanes + l] - offset);
        for (int i = 0; i < Dim; ++i) node[i] += value[(a * Dim + i) * Lanes + l];
      }
    }
  }
};

/// Calls `function(BatchLayout<Scalar, dim, lanes>{})` with the group's layout.
/// Groups of another layout do not exist: Model refuses them.
template <class Scalar, class Function>
void with_layout(const ElementGroup<Scalar>& group, Function&& function) {
  constexpr int full = batch_lanes<Scalar>;
  if (group.dim == 3) {
    group.lanes == 1 ? function(BatchLayout<Scalar, 3, 1>{})
                     : function(BatchLayout<Scalar, 3, full>{});
  } else {
    group.lanes == 1 ? function(BatchLayout<Scalar, 2, 1>{})
                     : function(BatchLayout<Scalar, 2, full>{});
  }
}

/// First bad element of one batch, given its lanes' status flags.
template <class Scalar>
[[nodiscard]] ElementStatus batch_status(const ElementGroup<Scalar>& group, std::size_t batch,
                                         const std::uint32_t* flags);

}  // namespace elastogen
