// The passes that see one fragment at a time, in order.
#pragma once

#include "symgen/dag/dag.h"
#include "symgen/stage_log.h"

namespace elastogen::symgen {

/// factor, group_stages, share_pairs, balance_numbers.
/// @param share_from  what is known earlier is left whole by share_pairs
[[nodiscard]] Graph simplified(Graph graph, Stage share_from, StageLog& log);

}  // namespace elastogen::symgen
