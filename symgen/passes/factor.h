// Factoring: sums of products with common factors become products of sums.
#pragma once

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// Greedy multivariate Horner, bottom-up: in each sum the factor that most terms share is taken
/// out, again and again. Whatever is known at rest stays whole (it will be a grouped constant).
///
/// Runs first, on freshly differentiated graphs whose products are flat, and before group_stages
/// and share_pairs, which see fewer and larger terms. Preserves the value of every root.
/// Source: Breuer's growth algorithm, as used by Hosangadi, Fallah & Kastner, Optimizing polynomial
/// expressions by algebraic factorization and CSE, IEEE Trans. CAD 25 (2006).
[[nodiscard]] Graph factor(const Graph& graph);

}  // namespace elastogen::symgen
