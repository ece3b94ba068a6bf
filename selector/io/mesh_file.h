// Mesh files: msh 2 and 4, mesh and unv by the gmsh library; vtk and vtu by VTK; decks of Abaqus
// and CalculiX (inp); and the triple of files (.obj, .element, .info) of X. Faure's thesis.
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
  Mesh mesh;  ///< a block for each element type of each region; node order of symgen/element;
              ///< `numbers` are the file's
  std::vector<MeshBoundary> boundaries;
  std::vector<std::string> associations;  ///< of each block, where the file names them
  std::vector<std::string> notes;         ///< what was left out or mended
};

/// What a scene says of its mesh file.
struct MeshFileOptions {
  std::vector<std::string> regions;  ///< that the scene names
  std::string region_array;          ///< .vtk and .vtu: the cell array; empty: a well-known one
};

/// Region of elements that are in no group.
inline constexpr const char* default_region = "default";

/// Reads a file; its extension says the format.
///
/// Groups of elements of the highest dimension are regions, those of lower ones boundaries; a group
/// without a name is called by its number. Groups are physical groups (.msh, .unv), references
/// (.mesh), the values of a cell array (.vtk, .vtu), or ELSETs, NSETs and SURFACEs (.inp). Elements
/// in several groups are of the region that `options.regions` names. A mesh is solid if it has
/// solid elements, else plane: then z must be the same everywhere. Nodes of no element are left
/// out, with a note.
/// @throws InputError  naming the file, what is wrong in it by its own numbers, and the remedy
/// @throws WorkError   when the program that reads for us is missing
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& file,
                                      const MeshFileOptions& options = {});

}  // namespace elastogen::selector
