// How VTK's cell types are our elements.
#pragma once

#include <string>
#include <vector>

namespace elastogen::selector {

/// One cell type: those that result files have (element_topology.h), voxels and pixels.
struct VtkCellType {
  std::string element;     ///< "hexa8"; empty for a type that is not ours
  std::vector<int> order;  ///< position in VTK's cell of each of our nodes
};

/// @param type  VTKCellType
[[nodiscard]] VtkCellType find_vtk_cell_type(int type);

}  // namespace elastogen::selector
