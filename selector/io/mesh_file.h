// Mesh files: msh 2 and 4, vtk, mesh and unv by the gmsh library; and the triple of files (.obj,
// .element, .info) of X. Faure's thesis.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// A named group of nodes, and of faces where the file lists any.
struct MeshBoundary {
  std::string name;
  std::vector<std::int32_t> nodes;               ///< ascending
  std::vector<std::vector<std::int32_t>> faces;  ///< edges in a plane mesh; in the file's direction
};

/// A mesh as a file has it. Its elements are right: of a kind that can be computed, with a volume
/// greater than 0, none twice, no face of more than two.
struct MeshFile {
  Mesh mesh;  ///< a block for each element type of each region; node order of symgen/element
  std::vector<MeshBoundary> boundaries;
  std::vector<std::uint64_t> element_numbers;  ///< the file's, in the order of `mesh`
  std::vector<std::string> associations;       ///< of each block, where the file names them
  std::vector<std::string> notes;              ///< what was left out or mended
};

/// Region of elements that are in no group.
inline constexpr const char* default_region = "default";

/// Reads a file; its extension says the format.
///
/// Physical groups of the highest dimension are regions, those of lower ones boundaries; a group
/// without a name is called by its number. In .mesh files the references are the groups; .vtk files
/// have none. A mesh is solid if it has solid elements, else plane: then z must be the same
/// everywhere. Nodes of no element are left out, with a note.
/// @throws InputError  naming the file, what is wrong in it by its own numbers, and the remedy
/// @throws WorkError   when the program that reads for us is missing
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& file);

}  // namespace elastogen::selector
