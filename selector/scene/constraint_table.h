// A [[constraint]] of a scene: which nodes are held, or moved, and how.
#pragma once

#include <array>
#include <optional>

#include "runtime/prescribed_motion.h"
#include "selector/scene/selection_table.h"

namespace elastogen::selector {

struct ConstraintDescription {
  NodeSelection nodes;
  /// Of each component: 0: fixed; none: free. All 0 with a rotation, which moves them.
  std::array<std::optional<double>, 3> displacement;
  std::optional<Rotation> rotation;
  /// When the displacement or the rotation is made. None: in statics it grows with the load.
  std::optional<History> history;
  std::string text;  ///< the table's content, for comparing scenes

  /// Whether anything but zero displacements is asked for.
  [[nodiscard]] bool moves() const;
};

/// @param dynamic  the scene is a motion in time: whatever moves then needs a history
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] ConstraintDescription read_constraint(const TomlTable& table, int dim, bool dynamic);

}  // namespace elastogen::selector
