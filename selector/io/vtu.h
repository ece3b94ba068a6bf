// Results for ParaView and other programs that read VTK's XML files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// A quantity per node: values[dim * node + component]; in a plane file the third component is 0.
struct NodeField {
  std::string name;
  std::span<const double> values;
};

/// A quantity per element, in the mesh's numbering through the blocks.
struct ElementField {
  std::string name;
  std::span<const double> values;
};

/// A choice per element: values[element] is an index into `names`, which have no line breaks.
struct ElementLabels {
  std::string name;
  std::vector<std::int32_t> values;
  std::vector<std::string> names;
};

/// What stands in a result file beside the mesh.
struct VtuFields {
  std::vector<NodeField> nodes;
  std::vector<ElementField> elements;
  std::vector<ElementLabels> labels;
};

/// Writes the mesh at rest with its fields as a binary VTK XML unstructured grid, atomically.
/// Fields become point and cell data under their names; labels become integer cell data NAME and
/// the bytes NAME_names in the field data: UTF-8, a line for each value from 0 on. Warping by the
/// point data "displacement" shows the deformed shape.
/// @throws InternalError  when a field's size does not fit the mesh
/// @throws WorkError      when the file cannot be written
void write_vtu(const std::filesystem::path& file, const Mesh& mesh, const VtuFields& fields);

}  // namespace elastogen::selector
