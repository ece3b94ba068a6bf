// Derivatives on the graph: reverse mode for gradients, forward mode along a direction.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// d root / d input for each input, by one backward sweep (adjoints): the graph of the gradient is
/// a small multiple of the root's, whatever the number of inputs.
/// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed., section 3.2.
[[nodiscard]] std::vector<NodeId> gradient(Dag& dag, NodeId root, std::span<const NodeId> inputs);

/// d root / d epsilon for each root at input_k + epsilon * direction_k, by one forward sweep.
/// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed., section 3.1.
[[nodiscard]] std::vector<NodeId> directional_derivative(
    Dag& dag, std::span<const NodeId> roots,
    const std::unordered_map<NodeId, NodeId>& direction_of_input);

}  // namespace elastogen::symgen
