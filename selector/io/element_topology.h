// What result files, pictures and mesh checks need to know of each element: its faces, and its
// place in VTK's cell types.
#pragma once

#include <array>
#include <cstddef>
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
                                        ///< edges have the element on their left. Of quadratic
                                        ///< elements corners first, then the node in the middle of
                                        ///< the edge from each corner to the next
  std::string_view linear = {};         ///< of quadratic elements, the one of the same corners
  std::vector<std::array<int, 2>> edges = {};  ///< of quadratic elements, the corners at the ends
                                               ///< of each edge with a node in its middle; these
                                               ///< nodes follow the corners, in this order

  [[nodiscard]] bool is_quadratic() const { return !edges.empty(); }
  [[nodiscard]] int num_corners() const { return num_nodes - static_cast<int>(edges.size()); }
};

/// Corners of a face with so many nodes; of 6 and 8, a quadratic face of a solid, the first half.
[[nodiscard]] constexpr std::size_t num_face_corners(std::size_t num_nodes) {
  return num_nodes > 4 ? num_nodes / 2 : num_nodes;
}

/// The nodes of a face of a solid in their order around it: corners, nodes in the middle of edges.
template <class Node>
[[nodiscard]] std::vector<Node> around_face(const std::vector<Node>& face) {
  const std::size_t corners = num_face_corners(face.size());
  if (corners == face.size()) return face;
  std::vector<Node> around;
  for (std::size_t c = 0; c < corners; ++c) {
    around.push_back(face[c]);
    around.push_back(face[corners + c]);
  }
  return around;
}

/// All elements that meshes may hold, in the order of legends.
[[nodiscard]] const std::vector<ElementTopology>& element_topologies();

/// @throws InputError  for an element that meshes cannot hold; says which they can
[[nodiscard]] const ElementTopology& element_topology(const std::string& element);

}  // namespace elastogen::selector
