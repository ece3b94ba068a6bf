// The [dynamics] table of a scene: how the body moves in time, and when the run ends.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "runtime/integrator.h"
#include "selector/scene/toml_table.h"

namespace elastogen::selector {

/// Ends a run early: the mean kinetic energy of a node has stayed below a threshold for a while
/// (thesis, section 5.2.2.3: epsilonStable, periode, tempsEtirement).
struct RestCriterion {
  double energy_per_node = 0;  ///< [J]
  double period = 0;           ///< for how long [s]
  double after = 0;            ///< not before this time [s]
};

struct DynamicsDescription {
  std::string step_where;            ///< "scene.toml:14", for messages
  std::optional<double> step;        ///< [s]; none: explicit, by the critical step
  double end = 0;                    ///< [s]
  std::array<double, 3> velocity{};  ///< of the free nodes at the start [m/s]
  std::array<double, 3> spin{};      ///< likewise, about the centre of mass [rad/s]
  std::optional<RestCriterion> rest;
  /// Scheme, damping, tolerances and iterations; step and linear solver are not set.
  IntegratorOptions options;
};

[[nodiscard]] bool is_explicit(IntegrationScheme scheme);

/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] DynamicsDescription read_dynamics(const TomlTable& table, int dim);

}  // namespace elastogen::selector
