// What a node costs.
#pragma once

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// Operations of one node, as the printers write it: additions, multiplications (factors of equal
/// size are taken out once), divisions, roots and functions.
struct OperationCount {
  long additions = 0, multiplications = 0, divisions = 0, functions = 0;

  /// Every operation as one; a fused multiply-add counts as two.
  [[nodiscard]] long flops() const { return additions + multiplications + divisions + functions; }
  /// In units of an addition on current vector units: a division costs about 8, a root or a
  /// logarithm about 20 (throughput, Fog, Instruction tables).
  [[nodiscard]] double time() const {
    return static_cast<double>(additions + multiplications) + 8.0 * static_cast<double>(divisions) +
           20.0 * static_cast<double>(functions);
  }
  OperationCount& operator+=(const OperationCount& other);
  [[nodiscard]] OperationCount times(long count) const {
    return {count * additions, count * multiplications, count * divisions, count * functions};
  }
};

[[nodiscard]] OperationCount cost_of(const Dag& dag, NodeId id);

/// Flops of what the roots need beyond what is known at rest.
[[nodiscard]] long flops_after_rest(const Graph& graph);

}  // namespace elastogen::symgen
