// A scene's static equilibrium, reached in load steps.
#pragma once

#include "selector/scene/motion_run.h"

namespace elastogen::selector {

/// Solves from rest, or from a checkpoint, and records the load steps.
///
/// @param start  the checkpoint to go on from; none: from rest
/// @param end    out: equilibrium, or the last state that was reached
/// @throws InputError, WorkError  as solve_static and Recorder
[[nodiscard]] NewtonResult run_static(const Scene& scene, const Problem& problem, Model& model,
                                      Recorder& recorder, const Checkpoint* start,
                                      const RunHooks& hooks, BodyState& end);

}  // namespace elastogen::selector
