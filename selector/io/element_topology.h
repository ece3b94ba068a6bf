// What result files, pictures and mesh checks need to know of each element: its faces, and its
// place in VTK's cell types.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// Faces and VTK numbering of one element. Local node numbers are those of symgen/element
/// (thesis tables 3.2 and 3.3).
struct ElementTopology {
  std::string_view element;  ///< "hexa8"
  std::string_view plural;   ///< "hexahedra", for messages and legends
  int dim = 3;               ///< 2: plane, `faces` are edges
  int num_nodes = 0;
  int vtk_cell_type = 0;                ///< VTKCellType
  std::vector<int> vtk_order;           ///< local node at each position of the VTK cell
  std::vector<std::vector<int>> faces;  ///< local nodes, counter-clockwise seen from outside;
                                        ///< edges have the element on their left
};

/// All elements that meshes may hold, in the order of legends.
[[nodiscard]] const std::vector<ElementTopology>& element_topologies();

/// @throws InputError  for an element that meshes cannot hold; says which they can
[[nodiscard]] const ElementTopology& element_topology(const std::string& element);

}  // namespace elastogen::selector
