// The mesh in a deck of Abaqus or CalculiX.
#pragma once

#include <filesystem>

#include "selector/mesh_readers/raw_mesh.h"

namespace elastogen::selector {

/// Reads *NODE, *ELEMENT, *NSET, *ELSET and *SURFACE, with what *INCLUDE brings. Element sets are
/// groups of their elements; node sets are groups of points, surfaces groups of faces. Sets that
/// Abaqus marks as INTERNAL count for what names them only. Materials, loads and steps are left
/// out, with a note.
/// @throws InputError  with file and line: what is wrong; parts and instances, and cards that make
///                     nodes or elements by rule, with what to do instead
[[nodiscard]] RawMesh read_abaqus_mesh(const std::filesystem::path& file);

}  // namespace elastogen::selector
