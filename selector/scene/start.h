// Where a static solve starts: at rest, or from shapes that ask everything of law and solver. And
// how a motion starts to turn.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/vector.h"

namespace elastogen::selector {

enum class Start {
  rest,
  inverted,   ///< mirrored in the plane x = centre: every element inside out
  flattened,  ///< projected onto the plane x = centre
  scrambled,  ///< every node somewhere in the body's box, the same places in every run
};

/// "rest", "inverted", "flattened", "scrambled", in the order of Start.
[[nodiscard]] const std::vector<std::string>& start_names();

/// Displacement of the start [m], [dim * node + component].
[[nodiscard]] Vector start_displacement(const Mesh& mesh, Start start);

/// Velocity of a rigid rotation about the centre of mass, w x (X - c) [m/s], [dim * node +
/// component].
/// @param mass  of each node [kg], their sum greater than 0
/// @param spin  angular velocity w [rad/s]; in the plane about z, the first two are 0
[[nodiscard]] Vector spin_velocity(const Mesh& mesh, std::span<const double> mass,
                                   const std::array<double, 3>& spin);

}  // namespace elastogen::selector
