#include "selector/io/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view merge_in_gmsh =
    "gmsh, by a script: Merge \"FILE\"; Coherence Mesh; Save \"joined.msh\"; or, before meshing, "
    "Coherence; on the geometry";
constexpr std::string_view merge_in_vtk = "ParaView: Clean to Grid; pyvista: mesh.clean()";
constexpr std::string_view vtk_boundaries =
    "the triangles and quadrilaterals (in the plane the lines) with one value of the cell array "
    "whose values are the regions";

constexpr std::array formats = {
    MeshFormat{".msh", MeshReader::gmsh,
               "a physical group of surfaces, curves or points, as by Physical Surface(\"NAME\") = "
               "{1}; once there is one group, gmsh saves nothing but groups",
               merge_in_gmsh,
               "once there is one physical group, gmsh saves nothing but groups: add Physical "
               "Volume(\"body\") = {1}; (or Mesh.SaveAll = 1;) and mesh again by -3"},
    MeshFormat{".vtk", MeshReader::vtk, vtk_boundaries, merge_in_vtk},
    MeshFormat{".vtu", MeshReader::vtk, vtk_boundaries, merge_in_vtk},
    MeshFormat{".inp", MeshReader::abaqus, "an *NSET, or a *SURFACE of elements",
               "Abaqus/CAE: Edit Mesh, Node, Merge"},
    MeshFormat{".unv", MeshReader::gmsh, "a group of faces, edges or points", merge_in_gmsh},
    MeshFormat{".mesh", MeshReader::gmsh, "a reference of faces, called by its number",
               merge_in_gmsh},
    MeshFormat{".obj", MeshReader::thesis,
               "none in the files of the thesis: select by plane or box",
               "in the program that wrote the files"},
};

/// What makes a mesh of a file that holds none for us.
std::string remedy_for(const fs::path& file, const std::string& extension) {
  const std::string name = file.filename().string(), stem = file.stem().string();
  const auto is_one_of = [&](std::initializer_list<const char*> extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  if (is_one_of({".stl", ".ply", ".off"})) {
    return fmt::format(
        "it holds only the surface of a body; mesh its volume first: write the lines  Merge "
        "\"{0}\"; Surface Loop(1) = Surface{{:}}; Volume(1) = {{1}}; Physical Volume(\"body\") = "
        "{{1}};  into {1}.geo, run  gmsh -3 {1}.geo -o {1}.msh  and name {1}.msh here",
        name, stem);
  }
  if (is_one_of({".geo", ".step", ".stp", ".iges", ".igs", ".brep"})) {
    return fmt::format(
        "it holds a geometry; mesh it first:  gmsh -3 {0} -o {1}.msh  and name {1}.msh here", name,
        stem);
  }
  if (is_one_of({".bdf", ".nas", ".fem", ".med", ".xdmf", ".e", ".exo", ".cgns", ".h5m", ".su2"})) {
    return fmt::format("convert it first:  meshio convert {0} {1}.vtu  and name {1}.vtu here", name,
                       stem);
  }
  if (is_one_of({".pvtu", ".vtm", ".vtp", ".vti", ".vts", ".pvd"})) {
    return fmt::format("open it in ParaView, take Append Datasets and save the result as {}.vtu",
                       stem);
  }
  return "";
}

}  // namespace

const MeshFormat& mesh_format(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::vector<std::string> known;
  for (const MeshFormat& format : formats) {
    if (format.extension == extension) return format;
    known.emplace_back(format.extension);
  }
  if (const std::string remedy = remedy_for(file, extension); !remedy.empty()) {
    throw InputError(fmt::format("{}: '{}' is no mesh format that is read: {}", file.string(),
                                 extension, remedy));
  }
  throw InputError(fmt::format("{}: the extension '{}' is of no mesh format{}; these are: {}",
                               file.string(), extension, did_you_mean(extension, known),
                               join(known, ", ")));
}

}  // namespace elastogen::selector
