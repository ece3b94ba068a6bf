// Which nodes a table of a scene selects: by a plane, a box, or a boundary's name.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "selector/scene/toml_table.h"

namespace elastogen::selector {

/// Nodes by position: those inside a box, limits included. A plane is a box without thickness. Or
/// by name: those of a boundary in a mesh file.
struct NodeSelection {
  std::string where;        ///< "scene.toml:14", for messages
  std::string description;  ///< "plane x = 8"
  std::array<double, 3> minimum{},
      maximum{};              ///< metres; infinite where not limited (z in the plane)
  std::string boundary = {};  ///< empty: by position
};

/// x, y, z; in the plane x, y
[[nodiscard]] std::vector<std::string> axes_of(int dim);

/// `axes_of(dim).size()` for what is no axis.
[[nodiscard]] std::size_t axis_number(const std::string& axis, int dim);

/// Reads the corners `min` and `max` of a box.
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] NodeSelection read_box(const TomlTable& box, int dim);

/// Reads `plane`, `box` or `boundary`, exactly one of which the table must have.
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] NodeSelection read_selection(const TomlTable& table, int dim);

}  // namespace elastogen::selector
