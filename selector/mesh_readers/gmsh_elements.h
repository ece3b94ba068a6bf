// How gmsh's element types are ours.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// One element type in both node orders. Gmsh's are drawn in its reference manual, "Node
/// ordering"; ours are those of symgen/element (thesis, tables 3.1 to 3.3; the
/// quadratic elements as symgen/element/shapes.h says).
struct GmshElement {
  std::int32_t type = 0;     ///< gmsh's number
  std::string_view element;  ///< "hexa8"
  std::vector<int> order;    ///< node of gmsh's element at each of our nodes
  std::vector<int> mirror;   ///< our nodes in the order of the mirrored element: inside out
};

/// All that a mesh may hold.
[[nodiscard]] const std::vector<GmshElement>& gmsh_elements();

/// Null for a type that is not ours.
[[nodiscard]] const GmshElement* find_gmsh_element(std::int32_t type);

}  // namespace elastogen::selector
