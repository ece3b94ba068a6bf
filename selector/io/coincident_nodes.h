// Nodes that lie on each other: legal (a crack), but mostly parts that were never joined.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/mesh.h"

namespace elastogen::selector {

struct CoincidentNodes {
  std::size_t count = 0;               ///< nodes that lie on one that comes before
  std::array<std::size_t, 2> first{};  ///< the first of them by number, after the one it lies on
};

/// Nodes nearer to each other than 1e-4 of the shortest edge at either: far
/// more than rounding and the six digits of some writers, far less than any gap that is meant. The
/// measure is the elements' own, so that neither the mesh's size nor its distance from the origin
/// matters. In O(n log n).
[[nodiscard]] CoincidentNodes find_coincident_nodes(const Mesh& mesh);

}  // namespace elastogen::selector
