// Where a static solve starts: at rest, or from shapes that ask everything of law and solver.
#pragma once

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

}  // namespace elastogen::selector
