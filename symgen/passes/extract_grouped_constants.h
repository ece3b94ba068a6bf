// Which values known at an early stage are stored, and which are computed again.
#pragma once

#include <span>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// Prices of the weighted cut, in units of one addition.
struct CutPrices {
  double stored =
      5;  ///< beta: reading one stored number (about 5 from L2, 20 from L3, 35 from DRAM)
  double position = 5;  ///< reading one rest position, shared between elements and gathered
};

/// The nodes of stage `stage` or earlier to be stored so that `roots` can be computed from them,
/// from rest positions, and from what is recomputed, at the least total cost
///   sum of prices of what is read + time of what is recomputed.
/// Exact: a maximum closure (project selection) by one maximum flow. Ascending ids. Rest positions
/// are never in the result at stage rest (they are inputs anyway); parameters cost nothing.
///
/// The same cut chooses grouped constants (stage rest) and the stored state of a two-stage product
/// (stage state; displacements are then stored like any other state).
/// Runs after share_pairs, since it prices the final nodes.
/// Source: Picard, Maximal closure of a graph, Management Science 22 (1976).
[[nodiscard]] std::vector<NodeId> minimum_cut(const Dag& dag, std::span<const NodeId> roots,
                                              Stage stage, const CutPrices& prices);

/// What the thesis's algorithm 6 stores: the largest subexpressions that hold only constants,
/// constant siblings of a sum or product grouped (group_stages has done that). Ascending ids.
[[nodiscard]] std::vector<NodeId> algorithm6(const Dag& dag, std::span<const NodeId> roots,
                                             Stage stage);

}  // namespace elastogen::symgen
