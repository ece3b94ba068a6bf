// The [mesh] table of a scene that names a mesh file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "selector/io/mesh_file.h"
#include "selector/scene/toml_table.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// What elements are computed with: either one law, with the usual quadrature of each element, or
/// an association for each kind of element.
struct ElementChoice {
  std::string path;   ///< "mesh.part[1]"
  std::string where;  ///< "scene.toml:14", for messages
  std::string law;    ///< empty: the associations say it
  std::string split = "auto";
  std::vector<symgen::AssociationId> associations;
};

/// A region that differs from the others.
struct MeshPartDescription {
  std::string region;
  std::string region_where;
  ElementChoice choice;
};

struct MeshFileDescription {
  std::string path;   ///< "mesh"
  std::string where;  ///< "scene.toml:14": the file's key, for messages
  std::filesystem::path file;
  std::shared_ptr<const MeshFile> mesh;  ///< what it holds, in its units
  double scale = 1;                      ///< metres per unit of the file
  std::optional<ElementChoice> choice;   ///< of regions without a part
  std::vector<MeshPartDescription> parts;
};

/// Reads the table and the file: the dimensions of all else in the scene are those of its mesh.
/// @param regions  that the scene's materials name
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] MeshFileDescription read_mesh_file_table(const TomlTable& table,
                                                       std::vector<std::string> regions);

}  // namespace elastogen::selector
