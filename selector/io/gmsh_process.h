// The gmsh library, at arm's length.
#pragma once

#include <filesystem>

#include "selector/gmsh_reader/raw_mesh.h"

namespace elastogen::selector {

/// Lets the program elastogen-gmsh read a mesh file, so that a crash of the library on a damaged
/// file is an error like another.
/// @throws InputError  with gmsh's message, or that it crashed
/// @throws WorkError   when the program is missing
[[nodiscard]] RawMesh read_with_gmsh(const std::filesystem::path& file);

}  // namespace elastogen::selector
