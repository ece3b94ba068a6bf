#include "selector/mesh_readers/vtk_cells.h"

#include <vtkCellType.h>

#include "selector/io/element_topology.h"

namespace elastogen::selector {

VtkCellType find_vtk_cell_type(int type) {
  // Their nodes go through the axes one by one instead of around.
  if (type == VTK_VOXEL) return {"hexa8", {0, 1, 3, 2, 4, 5, 7, 6}};
  if (type == VTK_PIXEL) return {"quad4", {0, 1, 3, 2}};
  for (const ElementTopology& topology : element_topologies()) {
    if (topology.vtk_cell_type != type) continue;
    VtkCellType cell{std::string(topology.element), topology.vtk_order};
    for (std::size_t k = 0; k < cell.order.size(); ++k) {
      cell.order[static_cast<std::size_t>(topology.vtk_order[k])] = static_cast<int>(k);
    }
    return cell;
  }
  return {};
}

}  // namespace elastogen::selector
