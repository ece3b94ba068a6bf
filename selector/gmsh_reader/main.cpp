// elastogen-gmsh FILE RECORD: reads a mesh file with the gmsh library and writes what it found
// (raw_mesh.h). A program of its own, because gmsh and the ninety libraries that it brings would
// triple the start of every command, and because gmsh crashes on some damaged files: then this
// process ends, and the tool says so.
// Exit status 0: RECORD is written; 1: not, and the reason stands on standard output.
#include <gmsh.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "selector/gmsh_reader/raw_mesh.h"

namespace {

using elastogen::selector::RawElements;
using elastogen::selector::RawMesh;

using GroupNumbers = std::map<std::pair<int, int>, std::int32_t>;

GroupNumbers read_groups(RawMesh& mesh) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  GroupNumbers numbers;
  for (const auto& [dim, tag] : groups) {
    numbers.emplace(std::pair(dim, tag), static_cast<std::int32_t>(mesh.groups.size()));
    std::string name;
    gmsh::model::getPhysicalName(dim, tag, name);
    mesh.groups.push_back({dim, tag, name});
  }
  return numbers;
}

void read_nodes(RawMesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> parametric;
  gmsh::model::mesh::getNodes(tags, mesh.coordinates, parametric);
  mesh.node_tags.assign(tags.begin(), tags.end());
}

void read_elements(const GroupNumbers& group_numbers, RawMesh& mesh) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dim, entity] : entities) {
    std::vector<int> types, groups;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
    gmsh::model::getPhysicalGroupsForEntity(dim, entity, groups);
    for (std::size_t t = 0; t < types.size(); ++t) {
      RawElements elements{dim, entity, types[t], {}, 0, {}, {}, {}};
      int element_dim = 0, order = 0, num_nodes = 0, num_primary_nodes = 0;
      std::vector<double> local_coordinates;
      gmsh::model::mesh::getElementProperties(types[t], elements.type_name, element_dim, order,
                                              num_nodes, local_coordinates, num_primary_nodes);
      elements.nodes_per_element = num_nodes;
      elements.tags.assign(tags[t].begin(), tags[t].end());
      elements.nodes.assign(nodes[t].begin(), nodes[t].end());
      for (const int group : groups) elements.groups.push_back(group_numbers.at({dim, group}));
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

RawMesh read_mesh(const std::string& file) {
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::merge(file);
  RawMesh mesh;
  const GroupNumbers groups = read_groups(mesh);
  read_nodes(mesh);
  read_elements(groups, mesh);
  mesh.warnings = log_lines("Warning");
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
