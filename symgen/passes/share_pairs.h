// Common subexpressions: pairs of operands that several sums or products hold.
#pragma once

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// Takes out the pair of operands that occurs most often, makes it a node, and repeats: first in
/// products, then in sums. Pairs of a sum are compared by the ratio of their factors, so a + 2 b
/// and 3 a + 6 b share. Only operands of one stage pair, so stages stay apart.
///
/// Runs after group_stages; on hexahedra it finds sum factorisation by itself. Works on nodes of
/// stage `from` and later; what is earlier is left whole. Preserves the value of every root.
/// Source: greedy pair extraction, Hosangadi, Fallah & Kastner (2006), "two-term CSE".
[[nodiscard]] Graph share_pairs(const Graph& graph, Stage from);

}  // namespace elastogen::symgen
