// Pattern of the assembled stiffness: one dim x dim block per pair of nodes that share an element.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/node_numbering.h"

namespace elastogen {

/// Where every entry of every element matrix goes: for nodes a, b of an element, the global entry
/// in row (b, i) and column (a, j) is values[slot(a, b) + j * column_length(node of a) + i].
class BlockPattern {
 public:
  /// The matrix is in the mesh's numbers, whatever those of the groups.
  template <class Scalar>
  BlockPattern(const std::vector<ElementGroup<Scalar>>& groups, const NodeNumbering& numbering,
               std::size_t num_nodes, int dim);

  /// Gives a matrix this pattern with values 0; leaves a matrix that has it alone.
  void shape(Eigen::SparseMatrix<double>& matrix) const;

  /// Slots of a group: slot(a, b) of its lane k, with n nodes per element, is at
  /// [(k * n + a) * n + b].
  [[nodiscard]] const std::vector<std::int32_t>& slots(std::size_t group) const {
    return slots_[group];
  }
  /// Values in one column of a node, which has the number that the groups give it.
  [[nodiscard]] std::int32_t column_length(std::size_t number) const {
    return column_lengths_[number];
  }
  [[nodiscard]] std::size_t num_values() const { return inner_.size(); }

 private:
  std::vector<std::int32_t> column_lengths_;      // [number of a node in the groups]
  std::vector<std::int32_t> outer_;               // compressed columns of the scalar matrix
  std::vector<std::int32_t> inner_;               // row of each value
  std::vector<std::vector<std::int32_t>> slots_;  // [group]
};

}  // namespace elastogen
