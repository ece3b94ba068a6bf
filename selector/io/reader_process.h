// The libraries gmsh and VTK, at arm's length.
#pragma once

#include <filesystem>
#include <string>

#include "selector/mesh_readers/raw_mesh.h"

namespace elastogen::selector {

enum class MeshLibrary { gmsh, vtk };

/// Lets the program elastogen-gmsh or elastogen-vtk read a mesh file, so that a crash of the
/// library on a damaged file is an error like another.
/// @param region_array  VTK only: the cell array whose values are the groups; empty: a well-known
/// one
/// @throws InputError  with the library's message, or that it crashed
/// @throws WorkError   when the program is missing
[[nodiscard]] RawMesh read_with(MeshLibrary library, const std::filesystem::path& file,
                                const std::string& region_array = "");

}  // namespace elastogen::selector
