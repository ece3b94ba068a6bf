// From an element's energies to the fragments of every operation: derivatives and passes in order.
#pragma once

#include "symgen/mechanics/element_graph.h"
#include "symgen/passes/profile.h"
#include "symgen/passes/split.h"
#include "symgen/pipeline.h"
#include "symgen/stage_log.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// The stages after mechanics, in order. `graph` is the element's.
/// @param log  gets a record of each stage
[[nodiscard]] VariantKernels build_kernels(ElementGraph graph, Geometry geometry,
                                           const Split& split, const Profile& profile,
                                           Grouping grouping, StageLog& log);

/// As `build_kernels`, each operation a loop over quadrature points: code of the size of one
/// point's, where straight-line code would not fit into an instruction cache, and what the
/// integration needs is derived once for all laws.
[[nodiscard]] VariantKernels build_point_kernels(PointwiseGraph graph, Geometry geometry,
                                                 const Profile& profile, Grouping grouping,
                                                 StageLog& log);

/// Flops of the largest kind of fragment that a split makes, by the product, the dearest operation
/// (what is known at rest not counted). Made from one Gauss point and one row part, since the
/// others are alike; `auto` compares it with the profile's limit.
[[nodiscard]] long typical_fragment_flops(ElementGraph graph, const Split& split);

}  // namespace elastogen::symgen
