// Which mesh files are read, and what messages say of each format.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace elastogen::selector {

enum class MeshReader { gmsh, vtk, abaqus, thesis };

struct MeshFormat {
  std::string_view extension;  ///< ".msh"
  MeshReader reader;
  std::string_view
      boundaries;          ///< what a boundary is there, for messages about one that is missing
  std::string_view merge;  ///< how nodes that lie on each other become one
  std::string_view volumes = {};  ///< how volumes get into the file, beyond meshing them
};

/// The format of a file's extension, in lower or upper case.
/// @throws InputError  for another: how to make a mesh of it where it has a surface, a geometry or
/// a
///                     mesh in a format that others read; else which formats there are
[[nodiscard]] const MeshFormat& mesh_format(const std::filesystem::path& file);

}  // namespace elastogen::selector
