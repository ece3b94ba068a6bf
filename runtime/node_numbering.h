// Numbers that passes over the elements give to nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/aligned_vector.h"
#include "runtime/element_group.h"

namespace elastogen {

/// The mesh's own numbers, or the order in which the batches come to the nodes: in a mesh that was
/// numbered without thought, passes then work on copies of the vectors in which the nodes of
/// neighbours stand together. A copy costs a few nanoseconds per node, of which there are no more
/// than elements.
class NodeNumbering {
 public:
  /// The mesh's own numbers.
  NodeNumbering() = default;
  /// Numbers nodes by appearance, and writes these numbers into the groups' dofs.
  template <class Scalar>
  NodeNumbering(std::vector<ElementGroup<Scalar>>& groups, std::size_t num_nodes);

  [[nodiscard]] bool is_of_mesh() const { return nodes_.empty(); }

  /// The mesh's number of a node.
  [[nodiscard]] std::int32_t node_of_mesh(std::int32_t number) const {
    return nodes_.empty() ? number : nodes_[static_cast<std::size_t>(number)];
  }

  /// Copies a node-major vector of the mesh into one in these numbers.
  void copy_from_mesh(const double* vector, int values_per_node, int threads, double* copy) const;
  /// vector += values, which are in these numbers.
  void add_to_mesh(const double* values, int values_per_node, int threads, double* vector) const;

 private:
  template <class Function>
  void for_each_node(const double* vector, int values_per_node, int threads,
                     Function&& function) const;

  std::vector<std::int32_t> nodes_;  // [number]; empty: the mesh's own numbers
};

}  // namespace elastogen
