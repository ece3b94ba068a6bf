// The last way from a file to a mesh, the same for all formats: checks, and what can be mended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "selector/io/mesh_file.h"

namespace elastogen::selector {

/// Elements as a file lists them together.
struct DraftElements {
  std::string element;  ///< "hexa8"
  std::string region;
  std::string association;             ///< empty where the file names none
  std::vector<std::int32_t> nodes;     ///< [e * nodes_per_element + a], our order
  std::vector<std::uint64_t> numbers;  ///< [e], the file's
};

struct MeshDraft {
  int dim = 3;
  std::vector<std::uint64_t> node_numbers;  ///< the file's
  std::vector<double> coordinates;          ///< [3 * node + component]
  std::vector<DraftElements> elements;
  std::vector<MeshBoundary> boundaries;
  std::vector<std::string> notes;
};

/// Turns lists of elements that are all inside out, drops nodes that no element has, joins lists
/// of the same element, region and association to blocks, and checks.
/// @throws InputError  a coordinate that is not finite; a plane mesh that is not flat; an inverted,
///                     degenerate or repeated element; a face of more than two elements; all by the
///                     file's numbers
[[nodiscard]] MeshFile finish_mesh(const std::filesystem::path& file, MeshDraft draft);

}  // namespace elastogen::selector
