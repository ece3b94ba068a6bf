// One geometry, written by gmsh in every format that it has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elastogen::selector {

/// Elements of one type and physical group, nodes numbered from 0 in gmsh's order.
struct WrittenElements {
  int type = 0;  ///< gmsh's
  std::vector<std::vector<int>> nodes;
  std::string group;  ///< empty: none
};

struct WrittenMesh {
  std::vector<double> coordinates;
  std::vector<WrittenElements> elements;
};

enum class MeshFormat { msh2, msh2_binary, msh4, msh4_binary, vtk, mesh, unv };

/// Writes a mesh; the file's numbers are ours plus 1, elements counted through the lists.
void write_with_gmsh(const WrittenMesh& mesh, MeshFormat format, const std::filesystem::path& file);

}  // namespace elastogen::selector
