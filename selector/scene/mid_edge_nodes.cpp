#include "selector/scene/mid_edge_nodes.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "runtime/error.h"
#include "selector/io/element_topology.h"

namespace elastogen::selector {
namespace {

/// The middle of an edge, made where an element comes to it first.
class EdgeNodes {
 public:
  explicit EdgeNodes(Mesh& mesh) : mesh_(mesh) {}

  std::int32_t between(std::int32_t a, std::int32_t b) {
    if (b < a) std::swap(a, b);
    const auto next = static_cast<std::int32_t>(mesh_.num_nodes());
    const auto [entry, is_new] = node_of_.try_emplace({a, b}, next);
    if (is_new) {
      const auto dim = static_cast<std::size_t>(mesh_.dim);
      for (std::size_t i = 0; i < dim; ++i) {
        mesh_.positions.push_back((mesh_.positions[dim * static_cast<std::size_t>(a) + i] +
                                   mesh_.positions[dim * static_cast<std::size_t>(b) + i]) /
                                  2);
      }
      made_.push_back({next, a, b});
    }
    return entry->second;
  }
  std::vector<MidEdgeNode> take() { return std::move(made_); }

 private:
  Mesh& mesh_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> node_of_;
  std::vector<MidEdgeNode> made_;
};

}  // namespace

std::vector<MidEdgeNode> add_mid_edge_nodes(Mesh& mesh, const std::vector<QuadraticBlock>& blocks) {
  EdgeNodes edge_nodes(mesh);
  for (const QuadraticBlock& quadratic : blocks) {
    ElementBlock& block = mesh.blocks.at(quadratic.block);
    const ElementTopology& topology = element_topology(quadratic.element);
    if (!topology.is_quadratic() || topology.linear != block.element) {
      throw InternalError(
          fmt::format("elements '{}' cannot become '{}'", block.element, quadratic.element));
    }
    std::vector<std::int32_t> nodes;
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const auto corners = block.element_nodes(e);
      nodes.insert(nodes.end(), corners.begin(), corners.end());
      for (const auto& [a, b] : topology.edges) {
        nodes.push_back(edge_nodes.between(corners[static_cast<std::size_t>(a)],
                                           corners[static_cast<std::size_t>(b)]));
      }
    }
    block.element = quadratic.element;
    block.nodes_per_element = topology.num_nodes;
    block.nodes = std::move(nodes);
  }
  return edge_nodes.take();
}

}  // namespace elastogen::selector
