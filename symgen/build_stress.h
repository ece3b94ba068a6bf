// The operation `stress` of one geometry variant, beside those that have been built.
#pragma once

#include "symgen/mechanics/stress_graph.h"
#include "symgen/passes/split.h"
#include "symgen/stage_log.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// The same passes as for the other operations, after these: their text and what they store stay as
/// they are. Stress stores and reads no constants and is not cut into steps: it is computed for
/// results only, once for many forces. Of a split it takes `g`, one fragment for each
/// point; law terms add up in every number, and there are no rows by node.
/// @param graph  of the element or, where the kernels are loops, of one point; in their numbers
void add_stress(VariantKernels& kernels, const StressGraph& graph, const Split& split,
                StageLog& log);

}  // namespace elastogen::symgen
