// A beam in bending and in torsion.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "selector/bench/work_precision_problem.h"

namespace elastogen::selector {

/// A part of the beam along its length.
struct BeamSection {
  double until = 1;         ///< of the length
  std::string association;  ///< "stvk-hexa8-q8-none"
};

/// The thesis's beam as a scene: 8 x 1 x 1 m, E = 100 MPa, nu = 0, 1000 kg/m^3, clamped at x = 0,
/// under its weight (g = 9.81 m/s^2).
[[nodiscard]] std::string bending_scene(std::span<const BeamSection> sections,
                                        const std::vector<int>& cells, const SolverChoice& solver);

/// The same beam without weight, its end turned by half a turn about the axis in five load steps.
[[nodiscard]] std::string torsion_scene(std::span<const BeamSection> sections,
                                        const std::vector<int>& cells, const SolverChoice& solver);

/// Error: of the mean displacement of the end face, as a vector.
[[nodiscard]] std::unique_ptr<WorkPrecisionProblem> make_bending_problem();

/// Error: of the moment at the end.
[[nodiscard]] std::unique_ptr<WorkPrecisionProblem> make_torsion_problem();

}  // namespace elastogen::selector
