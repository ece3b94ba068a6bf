// In which order nodes are eliminated by a sparse factorisation.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace elastogen {

/// The nodes' own order or one by minimum degree, whichever takes fewer multiplications: long
/// bodies numbered section by section do better as they are.
///
/// Ordering nodes instead of degrees of freedom makes the graph dim^2 times smaller.
/// Source: Amestoy, Davis & Duff, SIAM J. Matrix Anal. Appl. 17 (1996) 886-905.
/// @param stiffness  of all degrees of freedom, dim * node + component, full storage, compressed
/// @return every node, the first to be eliminated first
[[nodiscard]] std::vector<std::int32_t> elimination_order(
    const Eigen::SparseMatrix<double>& stiffness, int dim);

}  // namespace elastogen
