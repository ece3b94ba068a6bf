#include "selector/scene/mesh_file_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "selector/io/mesh_formats.h"
#include "selector/scene/located_error.h"

namespace elastogen::selector {
namespace {

/// The choice in a table, which may be none.
std::optional<ElementChoice> read_choice(const TomlTable& table) {
  if (!table.has("law") && !table.has("associations")) {
    if (table.has("split")) table.fail("split", "goes with 'law', which is missing");
    return std::nullopt;
  }
  ElementChoice choice;
  choice.path = table.path();
  if (table.has("law")) {
    if (table.has("associations")) table.fail("associations", "give either these or 'law'");
    choice.where = table.where("law");
    choice.law = table.string("law");
    if (table.has("split")) choice.split = table.string("split");
    return choice;
  }
  if (table.has("split")) table.fail("split", "goes with 'law'; associations name their splits");
  choice.where = table.where("associations");
  for (const std::string& text : table.strings("associations")) {
    choice.associations.push_back(with_location(choice.where, table.path_of("associations"), [&] {
      return symgen::AssociationId::parse(text);
    }));
    const std::string& element = choice.associations.back().element;
    const auto same = std::count_if(choice.associations.begin(), choice.associations.end(),
                                    [&](const auto& id) { return id.element == element; });
    if (same > 1) {
      table.fail("associations", fmt::format("there are two for {}: give one", element));
    }
  }
  return choice;
}

MeshPartDescription read_part(const TomlTable& table) {
  table.allow_only({"region", "law", "split", "associations"});
  std::optional<ElementChoice> choice = read_choice(table);
  if (!choice) {
    table.fail("needs law = \"stvk\", or associations = [\"stvk-tet4-q1-none\"]");
  }
  return {table.string("region"), table.where("region"), std::move(*choice)};
}

/// A given `dim` is a check on the file.
void check_dimension(const TomlTable& table, const MeshFileDescription& mesh) {
  if (!table.has("dim")) return;
  const int dim = table.integer("dim", 2);
  if (dim > 3) table.fail("dim", "must be 2 (plane strain) or 3");
  if (dim == mesh.mesh->mesh.dim) return;
  const std::string_view volumes = mesh_format(mesh.file).volumes;
  table.fail("dim", dim == 2
                        ? "the mesh file has solid elements: remove dim, or set it to 3"
                        : fmt::format("the mesh file has no solid elements, so it is plane: remove "
                                      "dim, set it to 2, or mesh the volume{}{}",
                                      volumes.empty() ? "" : "; ", volumes));
}

}  // namespace

MeshFileDescription read_mesh_file_table(const TomlTable& table, std::vector<std::string> regions) {
  table.allow_only({"file", "dim", "scale", "regions", "law", "split", "associations", "part"});
  MeshFileDescription mesh;
  mesh.path = table.path();
  mesh.where = table.where("file");
  mesh.file = std::filesystem::absolute(table.file()).parent_path() / table.string("file");
  if (table.has("scale")) mesh.scale = table.number("scale", positive_number);
  mesh.choice = read_choice(table);
  for (const TomlTable& part : table.tables("part")) {
    mesh.parts.push_back(read_part(part));
    const std::string& region = mesh.parts.back().region;
    const auto same = std::count_if(mesh.parts.begin(), mesh.parts.end(),
                                    [&](const auto& p) { return p.region == region; });
    if (same > 1) part.fail("region", "another part has this region: a region has one");
    regions.push_back(region);
  }
  MeshFileOptions options{std::move(regions), ""};
  if (table.has("regions")) options.region_array = table.string("regions");
  mesh.mesh = with_location(mesh.where, mesh.path + ".file", [&] {
    return std::make_shared<const MeshFile>(read_mesh_file(mesh.file, options));
  });
  check_dimension(table, mesh);
  return mesh;
}

}  // namespace elastogen::selector
