#include "selector/io/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/error.h"
#include "selector/io/gmsh_mesh.h"
#include "selector/io/gmsh_process.h"
#include "selector/io/thesis_mesh.h"
#include "selector/support/names.h"

namespace elastogen::selector {

MeshFile read_mesh_file(const std::filesystem::path& file) {
  static const std::vector<std::string> by_gmsh = {".msh", ".vtk", ".mesh", ".unv"};
  static const std::vector<std::string> all = {".msh", ".vtk", ".mesh", ".unv", ".obj"};
  const std::string extension = file.extension().string();
  if (std::find(all.begin(), all.end(), extension) == all.end()) {
    throw InputError(fmt::format("{}: the extension '{}' is of no mesh format{}; these are: {}",
                                 file.string(), extension, did_you_mean(extension, all),
                                 join(all, ", ")));
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(fmt::format("{}: there is no such file", file.string()));
  }
  return extension == ".obj" ? read_thesis_mesh(file) : make_gmsh_mesh(file, read_with_gmsh(file));
}

}  // namespace elastogen::selector
