// How a cell of a regular grid is cut into elements of one kind.
#pragma once

#include <string>
#include <vector>

namespace elastogen::selector {

/// The elements of one cell. Nodes are the cell's corners in the order of hexa8 (thesis, table
/// 3.2), 0 at the least x, y and z, 6 at the greatest; 8 is the cell's centre.
struct CubeCut {
  std::vector<std::vector<int>> elements;  ///< nodes of each, in the element's order
  bool uses_centre = false;
};

inline constexpr int cube_centre = 8;

/// hexa8: the cell itself. tet4: six around the diagonal 0-6. prism6: two, upright along z, cut
/// along 0-2 and 4-6. pyramid5: six, from the centre to each face. Plane cells have the corners 0
/// to 3. A quadratic element has the cut of the linear one on its corners. quad4: the cell itself.
/// tri3: two, cut along 0-2.
///
/// Neighbouring cells with the same cut fit together. Across faces x = constant, prisms, pyramids
/// and hexahedra fit each other (whole quadrilaterals); tetrahedra split those faces in two.
/// Source: thesis, annex C, for which element gets how many per cell.
/// @throws InputError  for an element that cells cannot be cut into; says which they can
[[nodiscard]] const CubeCut& cube_cut(const std::string& element);

}  // namespace elastogen::selector
