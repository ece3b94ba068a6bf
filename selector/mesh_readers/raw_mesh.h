// What a mesh file holds, before anything is decided: the record that the programs elastogen-gmsh
// and elastogen-vtk hand to the tool.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// A named set of elements of one dimension: a physical group, a value of a cell array, an ELSET.
struct RawGroup {
  std::int32_t dim = 0;
  std::int32_t number = 0;
  std::string name;  ///< empty where the file gives none: the number stands for it
};

/// Elements of one type in the same groups.
struct RawElements {
  std::int32_t dim = 0;   ///< 0 points ... 3 solids
  std::string element;    ///< "hexa8"; empty: not one that can be computed
  std::string type_name;  ///< "Hexahedron 8", as the file's format calls it
  std::int32_t nodes_per_element = 0;
  std::vector<std::uint64_t> numbers;  ///< [e], the file's
  std::vector<std::uint64_t> nodes;    ///< [e * nodes_per_element + a], the file's numbers; in our
                                       ///< order where `element` is ours
  std::vector<std::int32_t> groups;    ///< indices into RawMesh::groups
};

struct RawMesh {
  std::vector<std::uint64_t> node_numbers;  ///< the file's
  std::vector<double> coordinates;          ///< [3 * node + component]
  std::vector<RawGroup> groups;
  std::vector<RawElements> elements;
  std::vector<std::string> notes;  ///< what the user should hear of
};

/// The record as bytes, for the same machine.
[[nodiscard]] std::string pack(const RawMesh& mesh);

/// @throws InternalError  for bytes that `pack` has not made
[[nodiscard]] RawMesh unpack(std::string_view bytes);

}  // namespace elastogen::selector
