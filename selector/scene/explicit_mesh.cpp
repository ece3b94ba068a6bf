#include "selector/scene/explicit_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "runtime/error.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_faces.h"
#include "selector/scene/located_error.h"

namespace elastogen::selector {
namespace {

void check_node_numbers(const BlockDescription& block, std::size_t first_element,
                        std::size_t num_nodes) {
  for (std::size_t e = 0; e < block.elements.size(); ++e) {
    const std::vector<int>& nodes = block.elements[e];
    for (const int node : nodes) {
      if (static_cast<std::size_t>(node) >= num_nodes) {
        throw InputError(
            fmt::format("{}: {}: element {} has the node {}: nodes are numbered from 0 "
                        "to {}",
                        block.elements_where, block.path, first_element + e, node, num_nodes - 1));
      }
      if (std::count(nodes.begin(), nodes.end(), node) > 1) {
        throw InputError(
            fmt::format("{}: {}: element {} has the node {} twice: its nodes must "
                        "differ",
                        block.elements_where, block.path, first_element + e, node));
      }
    }
  }
}

/// Elements by their sets of nodes: none may come twice, none be left out.
void check_use_of_nodes(const ExplicitMeshDescription& description, const Mesh& mesh) {
  std::vector<bool> used(mesh.num_nodes(), false);
  std::map<std::set<std::int32_t>, std::size_t> seen;
  std::size_t element = 0;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.num_elements(); ++e, ++element) {
      const auto nodes = block.element_nodes(e);
      const auto [first, is_new] =
          seen.emplace(std::set<std::int32_t>(nodes.begin(), nodes.end()), element);
      if (!is_new) {
        throw InputError(fmt::format("{}: mesh: elements {} and {} have the same nodes: remove one",
                                     description.where, first->second, element));
      }
      for (const std::int32_t node : nodes) used[static_cast<std::size_t>(node)] = true;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end()) {
    throw InputError(
        fmt::format("{}: mesh.nodes: node {} belongs to no element: remove it, or add "
                    "its element",
                    description.where, unused - used.begin()));
  }
}

void check_faces(const ExplicitMeshDescription& description, const Mesh& mesh,
                 const FaceMatching& matching) {
  if (matching.overused.empty()) return;
  const MeshFace& face = matching.overused.front();
  std::size_t element = face.element;
  for (std::size_t b = 0; b < face.block; ++b) element += mesh.blocks[b].num_elements();
  throw InputError(fmt::format(
      "{}: mesh: the {} with nodes {} of element {} belongs to more than "
      "two elements: elements overlap",
      description.where, mesh.dim == 2 ? "edge" : "face", fmt::join(face.nodes, " "), element));
}

}  // namespace

SceneMesh make_explicit_mesh(const ExplicitMeshDescription& description) {
  SceneMesh result;
  Mesh& mesh = result.mesh;
  mesh.dim = element_topology(description.blocks.front().association.element).dim;
  for (const std::vector<double>& node : description.nodes) {
    mesh.positions.insert(mesh.positions.end(), node.begin(), node.end());
  }
  for (const BlockDescription& source : description.blocks) {
    check_node_numbers(source, mesh.num_elements(), description.nodes.size());
    ElementBlock block;
    block.element = source.association.element;
    block.nodes_per_element =
        with_location(source.association_where, source.path + ".association",
                      [&] { return element_topology(block.element).num_nodes; });
    const std::int32_t region = region_number(mesh, source.region);
    for (const std::vector<int>& nodes : source.elements) {
      block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
      block.region.push_back(region);
    }
    mesh.blocks.push_back(std::move(block));
    result.blocks.push_back({source.path, source.association, source.association_where,
                             source.region, source.region_where});
  }
  check_use_of_nodes(description, mesh);
  const FaceMatching matching = match_faces(mesh);
  check_faces(description, mesh, matching);
  result.split_quadrilaterals = matching.split_quadrilaterals.size();
  result.unequal_faces = matching.unequal.size();
  return result;
}

}  // namespace elastogen::selector
