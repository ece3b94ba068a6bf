#include "mesh_writer.h"

#include <gmsh.h>

#include <map>
#include <numeric>

namespace elastogen::selector {
namespace {

int dimension_of(int type) {
  static const std::map<int, int> dimensions = {{15, 0}, {1, 1},  {2, 2}, {3, 2},  {4, 3},
                                                {5, 3},  {6, 3},  {7, 3}, {11, 3}, {9, 2},
                                                {16, 2}, {17, 3}, {12, 3}};
  return dimensions.at(type);
}

void set_format(MeshFormat format) {
  const bool binary = format == MeshFormat::msh2_binary || format == MeshFormat::msh4_binary;
  const bool version2 = format == MeshFormat::msh2 || format == MeshFormat::msh2_binary;
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
  gmsh::option::setNumber("Mesh.MshFileVersion", version2 ? 2.2 : 4.1);
  // Elements without a group are written too, except to version 2, where it would lose the groups.
  gmsh::option::setNumber("Mesh.SaveAll", version2 ? 0 : 1);
  gmsh::option::setNumber("Mesh.SaveGroupsOfNodes", 1);
}

/// An entity for each list, so that each can be in a group of its own.
void add_entities(const WrittenMesh& mesh) {
  std::map<std::pair<int, std::string>, std::vector<int>> groups;
  std::size_t tag = 1;
  bool has_nodes = false;
  for (const WrittenElements& elements : mesh.elements) {
    const int dim = dimension_of(elements.type);
    const int entity = gmsh::model::addDiscreteEntity(dim);
    if (!has_nodes) {
      std::vector<std::size_t> tags(mesh.coordinates.size() / 3);
      std::iota(tags.begin(), tags.end(), std::size_t{1});
      gmsh::model::mesh::addNodes(dim, entity, tags, mesh.coordinates);
      has_nodes = true;
    }
    std::vector<std::size_t> tags, nodes;
    for (const std::vector<int>& element : elements.nodes) {
      tags.push_back(tag++);
      for (const int node : element) nodes.push_back(static_cast<std::size_t>(node) + 1);
    }
    gmsh::model::mesh::addElements(dim, entity, {elements.type}, {tags}, {nodes});
    if (!elements.group.empty()) groups[{dim, elements.group}].push_back(entity);
  }
  for (const auto& [key, entities] : groups) {
    const int group = gmsh::model::addPhysicalGroup(key.first, entities);
    gmsh::model::setPhysicalName(key.first, group, key.second);
  }
}

}  // namespace

void write_with_gmsh(const WrittenMesh& mesh, MeshFormat format,
                     const std::filesystem::path& file) {
  gmsh::initialize(0, nullptr, false);
  set_format(format);
  gmsh::model::add("mesh");
  add_entities(mesh);
  gmsh::write(file.string());
  gmsh::finalize();
}

}  // namespace elastogen::selector
