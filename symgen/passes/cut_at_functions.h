// A computation in three steps around the functions that it waits for.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// What three steps compute: the arguments of functions, the functions and whatever stands between
/// two of them, and the rest. Functions are logarithms, exponentials, roots and reciprocals of what
/// an element's displacement changes; from their arguments to their results pass tens of cycles, in
/// which a processor that runs the steps of several elements in turn computes those of the others.
struct FunctionCut {
  std::vector<NodeId> arguments;  ///< stored by the first step for the second and third
  std::vector<NodeId> functions;  ///< stored by the second step for the third
  /// Of each root the step that computes it: 0, 1, 2.
  std::vector<int> step_of_root;
};

/// The cut of what computes `roots` from parameters, numbers and `inputs`; none if no function is
/// waited for. Values that are one operation on inputs away are computed again instead of stored.
/// @param inputs  [node], whether it is given
[[nodiscard]] std::optional<FunctionCut> cut_at_functions(const Dag& dag,
                                                          std::span<const NodeId> roots,
                                                          const std::vector<bool>& inputs);

}  // namespace elastogen::symgen
