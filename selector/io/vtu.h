// Results for ParaView and other programs that read VTK's XML files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// A quantity per node: values[components * node + component]. Without a number of components it
/// is a vector of the mesh's dimensions; in a plane file the third component is 0 then.
struct NodeField {
  std::string name;
  std::span<const double> values;
  int components = 0;
  std::vector<std::string> component_names = {};  ///< none, or one for each
};

/// A quantity per element, in the mesh's numbering through the blocks:
/// values[components * element + component].
struct ElementField {
  std::string name;
  std::span<const double> values;
  int components = 1;
  std::vector<std::string> component_names = {};
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

/// Writes points alone, each a vertex, with their fields as point data, likewise.
/// @param positions  in space [3 * point + component]
/// @throws InternalError, WorkError  as write_vtu
void write_points_vtu(const std::filesystem::path& file, std::span<const double> positions,
                      const std::vector<NodeField>& fields);

}  // namespace elastogen::selector
