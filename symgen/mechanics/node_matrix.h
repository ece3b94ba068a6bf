// Small matrices of nodes of a graph.
#pragma once

#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

using NodeMatrix = std::vector<std::vector<NodeId>>;  ///< [row][column]

/// Adds the entries row after row.
void append(std::vector<NodeId>& entries, const NodeMatrix& matrix);

/// Of 2 x 2 and 3 x 3 matrices.
[[nodiscard]] NodeId determinant_of(Dag& dag, const NodeMatrix& m);
[[nodiscard]] NodeMatrix inverse_of(Dag& dag, const NodeMatrix& m);

/// Of a matrix whose other entries are zero.
[[nodiscard]] NodeMatrix inverse_of_diagonal(Dag& dag, const NodeMatrix& m);

[[nodiscard]] NodeMatrix matrix_product(Dag& dag, const NodeMatrix& a, const NodeMatrix& b);

}  // namespace elastogen::symgen
