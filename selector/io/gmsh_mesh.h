// From gmsh's record of a file to a mesh.
#pragma once

#include <filesystem>

#include "selector/gmsh_reader/raw_mesh.h"
#include "selector/io/mesh_file.h"

namespace elastogen::selector {

/// Sorts gmsh's elements into regions and boundaries.
///
/// @param file  for messages; its extension says how groups are given
/// @throws InputError  no elements; elements of a type that cannot be computed, with their count;
///                     solids in more than one group; what finish_mesh refuses
[[nodiscard]] MeshFile make_gmsh_mesh(const std::filesystem::path& file, const RawMesh& raw);

}  // namespace elastogen::selector
