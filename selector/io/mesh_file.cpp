#include "selector/io/mesh_file.h"

#include <fmt/format.h>

#include "runtime/error.h"
#include "selector/io/abaqus_mesh.h"
#include "selector/io/mesh_draft.h"
#include "selector/io/mesh_formats.h"
#include "selector/io/mesh_groups.h"
#include "selector/io/reader_process.h"
#include "selector/io/thesis_mesh.h"

namespace elastogen::selector {

MeshFile read_mesh_file(const std::filesystem::path& file, const MeshFileOptions& options) {
  const MeshFormat& format = mesh_format(file);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(fmt::format("{}: there is no such file", file.string()));
  }
  if (!options.region_array.empty() && format.reader != MeshReader::vtk) {
    throw InputError(
        fmt::format("{}: regions = \"{}\" names a cell array, which only .vtk and .vtu files have; "
                    "in this file regions are its groups",
                    file.string(), options.region_array));
  }
  RawMesh raw;
  switch (format.reader) {
    case MeshReader::thesis:
      return read_thesis_mesh(file);
    case MeshReader::abaqus:
      raw = read_abaqus_mesh(file);
      break;
    case MeshReader::gmsh:
      raw = read_with(MeshLibrary::gmsh, file);
      break;
    case MeshReader::vtk:
      raw = read_with(MeshLibrary::vtk, file, options.region_array);
      break;
  }
  return finish_mesh(file, make_draft(file, raw, options.regions));
}

}  // namespace elastogen::selector
