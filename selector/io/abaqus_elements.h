// The element types of Abaqus and CalculiX, and how their faces are numbered.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// One element type. The nodes of those that are ours come in our order: Abaqus has corners as
/// ours, and nodes of edges as 01 12 20 03 13 23 and 01 12 23 30 45 56 67 74 04 15 26 37.
struct AbaqusElement {
  int dim = 0;
  int num_nodes = 0;
  std::string_view element = {};  ///< "hexa8"; empty: not ours
};

/// Solids C3D*, plane elements CPE* and CPS*; and, for what surrounds them, CAX*, shells S* and
/// STRI*, membranes and surfaces M3D*, SFM3D*, R3D*, trusses T2D*, T3D* and beams B*. Letters after
/// the number of nodes (C3D8I, C3D10M) say how Abaqus computes the element, and nothing of the
/// mesh.
/// @param type  in capitals
/// @return      nothing for another type
[[nodiscard]] std::optional<AbaqusElement> find_abaqus_element(std::string_view type);

/// Solids C3D*, and plane elements CPE* and CPS*: families of which we have elements.
[[nodiscard]] bool is_solid_or_plane(std::string_view type);

/// Local nodes of face S1, S2, ... of one of our elements, as ElementTopology::faces has them: S1
/// is the first. Edges of plane elements. Source: Abaqus Analysis User's Guide, "Three-dimensional
/// solid element library" and "Two-dimensional solid element library"; the CalculiX manual has the
/// same.
[[nodiscard]] std::vector<std::vector<int>> abaqus_faces(std::string_view element);

}  // namespace elastogen::selector
