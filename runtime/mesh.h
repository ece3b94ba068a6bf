// Mesh: nodes, and blocks of elements of one type each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elastogen {

/// Elements of one type.
struct ElementBlock {
  std::string element;  ///< "tri3", "quad4", "tet4", "hexa8", ...; node order of symgen/element
  int nodes_per_element = 0;
  std::vector<std::int32_t> nodes;   ///< [e * nodes_per_element + a], global node numbers
  std::vector<std::int32_t> region;  ///< [e], index into Mesh::region_names

  [[nodiscard]] std::size_t num_elements() const { return region.size(); }
  [[nodiscard]] std::span<const std::int32_t> element_nodes(std::size_t e) const {
    return {nodes.data() + e * static_cast<std::size_t>(nodes_per_element),
            static_cast<std::size_t>(nodes_per_element)};
  }
};

/// By which messages call nodes and elements: those of a mesh file.
struct MeshNumbers {
  std::vector<std::uint64_t> nodes, elements;
};

/// A mesh of mixed blocks. Positions are node-major: positions[dim * node + component], metres.
/// Elements are numbered through the blocks in order, from 0. A plane mesh (dim 2) is a body in
/// plane strain, 1 m thick: its volumes, masses, energies and forces are those of that thickness.
struct Mesh {
  int dim = 3;
  std::vector<double> positions;
  std::vector<ElementBlock> blocks;
  std::vector<std::string> region_names;
  std::shared_ptr<const MeshNumbers> numbers = nullptr;  ///< null: messages count from 0

  /// What messages call a node.
  [[nodiscard]] std::uint64_t node_number(std::size_t node) const {
    return numbers ? numbers->nodes[node] : node;
  }
  /// What messages call an element.
  [[nodiscard]] std::uint64_t element_number(std::size_t element) const {
    return numbers ? numbers->elements[element] : element;
  }
  [[nodiscard]] std::size_t num_nodes() const {
    return positions.size() / static_cast<std::size_t>(dim);
  }
  [[nodiscard]] std::size_t num_elements() const {
    std::size_t count = 0;
    for (const ElementBlock& block : blocks) count += block.num_elements();
    return count;
  }
};

}  // namespace elastogen
