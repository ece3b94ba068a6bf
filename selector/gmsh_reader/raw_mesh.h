// What gmsh finds in a mesh file, before anything is decided: the record that the program
// elastogen-gmsh hands to the tool.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// A physical group.
struct RawGroup {
  std::int32_t dim = 0;
  std::int32_t number = 0;
  std::string name;  ///< empty where the file gives none
};

/// Elements of one type in one of gmsh's entities.
struct RawElements {
  std::int32_t dim = 0;     ///< of the elements: 0 points ... 3 solids
  std::int32_t entity = 0;  ///< its number among those of this dimension
  std::int32_t type = 0;    ///< gmsh's number of the element type
  std::string type_name;    ///< "Hexahedron 8"
  std::int32_t nodes_per_element = 0;
  std::vector<std::uint64_t> tags;   ///< [e], the file's numbers
  std::vector<std::uint64_t> nodes;  ///< [e * nodes_per_element + a], tags, in gmsh's order
  std::vector<std::int32_t> groups;  ///< indices into RawMesh::groups
};

struct RawMesh {
  std::vector<std::uint64_t> node_tags;
  std::vector<double> coordinates;  ///< [3 * node + component]
  std::vector<RawGroup> groups;
  std::vector<RawElements> elements;
  std::vector<std::string> warnings;  ///< gmsh's own
};

/// The record as bytes, for the same machine.
[[nodiscard]] std::string pack(const RawMesh& mesh);

/// @throws InternalError  for bytes that `pack` has not made
[[nodiscard]] RawMesh unpack(std::string_view bytes);

}  // namespace elastogen::selector
