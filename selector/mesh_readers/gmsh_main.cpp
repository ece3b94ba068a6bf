// elastogen-gmsh FILE RECORD: reads a mesh file with the gmsh library and writes what it found
// (raw_mesh.h). A program of its own, because gmsh and the ninety libraries that it brings would
// triple the start of every command, and because gmsh crashes on some damaged files: then this
// process ends, and the tool says so.
// Exit status 0: RECORD is written; 1: not, and the reason stands on standard output.
#include <gmsh.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "selector/mesh_readers/gmsh_elements.h"
#include "selector/mesh_readers/raw_mesh.h"

namespace {

using elastogen::selector::find_gmsh_element;
using elastogen::selector::GmshElement;
using elastogen::selector::RawElements;
using elastogen::selector::RawMesh;

/// Indices into RawMesh::groups by dimension and number.
using GroupIndices = std::map<std::pair<int, int>, std::int32_t>;

GroupIndices read_groups(RawMesh& mesh) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  GroupIndices indices;
  for (const auto& [dim, tag] : groups) {
    indices.emplace(std::pair(dim, tag), static_cast<std::int32_t>(mesh.groups.size()));
    std::string name;
    gmsh::model::getPhysicalName(dim, tag, name);
    mesh.groups.push_back({dim, tag, name});
  }
  return indices;
}

void read_nodes(RawMesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> parametric;
  gmsh::model::mesh::getNodes(tags, mesh.coordinates, parametric);
  mesh.node_numbers.assign(tags.begin(), tags.end());
}

/// In our order, where the type is ours.
void add_nodes(const std::vector<std::size_t>& nodes, const GmshElement* type,
               RawElements& elements) {
  const auto count = static_cast<std::size_t>(elements.nodes_per_element);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t a = i % count;
    elements.nodes.push_back(
        type == nullptr ? nodes[i] : nodes[i - a + static_cast<std::size_t>(type->order[a])]);
  }
}

/// A msh 2 file repeats an element for each group that it is in.
void drop_repeated(RawElements& elements) {
  const RawElements all = elements;
  const auto count = static_cast<std::ptrdiff_t>(all.nodes_per_element);
  std::set<std::vector<std::uint64_t>> seen;
  elements.numbers.clear();
  elements.nodes.clear();
  for (std::size_t e = 0; e < all.numbers.size(); ++e) {
    const auto first = all.nodes.begin() + static_cast<std::ptrdiff_t>(e) * count;
    if (!seen.emplace(first, first + count).second) continue;
    elements.numbers.push_back(all.numbers[e]);
    elements.nodes.insert(elements.nodes.end(), first, first + count);
  }
}

/// @param entities_are_groups  of medit's files: gmsh makes entities of their references
void read_elements(GroupIndices& indices, bool entities_are_groups, RawMesh& mesh) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  const int body_dim = gmsh::model::getDimension();
  for (const auto& [dim, entity] : entities) {
    std::vector<int> types, groups;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
    gmsh::model::getPhysicalGroupsForEntity(dim, entity, groups);
    // References of medit's edges and vertices have no meaning beside those of faces.
    if (entities_are_groups && dim >= body_dim - 1) {
      groups.push_back(entity);
      if (indices.emplace(std::pair(dim, entity), static_cast<std::int32_t>(mesh.groups.size()))
              .second) {
        mesh.groups.push_back({dim, entity, ""});
      }
    }
    for (std::size_t t = 0; t < types.size(); ++t) {
      RawElements elements;
      elements.dim = dim;
      int element_dim = 0, order = 0, num_nodes = 0, num_primary_nodes = 0;
      std::vector<double> local_coordinates;
      gmsh::model::mesh::getElementProperties(types[t], elements.type_name, element_dim, order,
                                              num_nodes, local_coordinates, num_primary_nodes);
      const GmshElement* type = find_gmsh_element(types[t]);
      if (type != nullptr) elements.element = type->element;
      elements.nodes_per_element = num_nodes;
      elements.numbers.assign(tags[t].begin(), tags[t].end());
      add_nodes(nodes[t], type, elements);
      for (const int group : groups) elements.groups.push_back(indices.at({dim, group}));
      if (groups.size() > 1) drop_repeated(elements);
      mesh.elements.push_back(std::move(elements));
    }
  }
}

/// Lines of gmsh's log of one kind, without its name.
std::vector<std::string> log_lines(const std::string& kind) {
  std::vector<std::string> log, lines;
  gmsh::logger::get(log);
  for (const std::string& line : log) {
    if (line.starts_with(kind + ": ")) lines.push_back(line.substr(kind.size() + 2));
  }
  return lines;
}

/// As mesh_formats takes it: in lower or upper case.
bool is_medit(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension == ".mesh";
}

RawMesh read_mesh(const std::string& file) {
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::merge(file);
  RawMesh mesh;
  GroupIndices groups = read_groups(mesh);
  read_nodes(mesh);
  read_elements(groups, is_medit(file), mesh);
  for (const std::string& warning : log_lines("Warning")) mesh.notes.push_back("gmsh: " + warning);
  return mesh;
}

/// Gmsh's log says more than its exceptions, where it has an error.
int fail(const std::string& reason) {
  const std::vector<std::string> errors = log_lines("Error");
  std::printf("%s", errors.empty() ? reason.c_str() : errors.back().c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::printf("usage: elastogen-gmsh FILE RECORD");
    return 1;
  }
  gmsh::initialize(0, nullptr, false);
  gmsh::logger::start();
  try {
    const std::string bytes = elastogen::selector::pack(read_mesh(argv[1]));
    std::ofstream record(argv[2], std::ios::binary);
    record << bytes << std::flush;
    if (!record) return fail("the record cannot be written");
    return 0;
  } catch (const std::string& error) {
    return fail(error);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
