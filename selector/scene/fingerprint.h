// Tells whether two runs would make the same steps.
#pragma once

#include <span>
#include <string>

#include "runtime/vector.h"
#include "selector/scene/problem.h"
#include "selector/scene/simulation.h"

namespace elastogen::selector {

/// A hash of all that a run's steps depend on but its state and the number of threads: mesh,
/// kernels, materials, constraints, load, scheme and tolerances. When a run ends, what it writes
/// and what it is called do not count.
///
/// @param kernels    of each block of the mesh
/// @param load       on all degrees of freedom [N]
/// @param time_step  [s]; 0 in statics
[[nodiscard]] std::string run_fingerprint(const Scene& scene, const Problem& problem,
                                          std::span<const BlockKernels> kernels, const Vector& load,
                                          double time_step);

}  // namespace elastogen::selector
