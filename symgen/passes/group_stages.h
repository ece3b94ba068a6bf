// Grouping by stage: what is known earlier becomes a node of its own.
#pragma once

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// Splits every sum and product so that the operands known earlier form one node, nested from the
/// earliest stage to the latest: a (b c) with a at rest, b of the state and c of the direction
/// becomes ((a b) c). Writes negative and broken exponents as whole powers of one reciprocal or
/// root per base (x^-2 = (x^-1)^2).
///
/// Runs after factor (which needs flat products) and before share_pairs and the stage cut (which
/// look for whole nodes of one stage). Preserves the value of every root.
[[nodiscard]] Graph group_stages(const Graph& graph);

}  // namespace elastogen::symgen
