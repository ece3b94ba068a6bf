// Numbers in sums, taken into what is known at rest.
#pragma once

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// The same values with fewer multiplications by numbers: where 2 mu x + y, x' + mu y'/2 ... become
/// (2 mu) x + y, ..., a multiple of what is known at rest is computed once instead. Greedy: of all
/// multiples of such factors, by a size that stands in some sum, the one that saves most is taken,
/// until none saves anything.
///
/// Runs after share_pairs, whose nodes are final. A multiple is a product with a number among its
/// operands, which Dag::sum and Dag::product_of_groups leave whole.
[[nodiscard]] Graph balance_numbers(const Graph& graph);

}  // namespace elastogen::symgen
