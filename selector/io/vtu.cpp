#include "selector/io/vtu.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <limits>

#include "runtime/error.h"
#include "selector/io/element_topology.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

void add_cells(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  grid.Allocate(static_cast<vtkIdType>(mesh.num_elements()));
  for (const ElementBlock& block : mesh.blocks) {
    const ElementTopology& topology = element_topology(block.element);
    std::vector<vtkIdType> cell(static_cast<std::size_t>(topology.num_nodes));
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const auto nodes = block.element_nodes(e);
      for (std::size_t k = 0; k < cell.size(); ++k) {
        cell[k] = nodes[static_cast<std::size_t>(topology.vtk_order[k])];
      }
      grid.InsertNextCell(topology.vtk_cell_type, topology.num_nodes, cell.data());
    }
  }
}

/// Tuples of `given` values each, filled up with 0 to `components`.
vtkNew<vtkDoubleArray> double_array(const std::string& name, std::span<const double> values,
                                    int given, int components, std::size_t tuples) {
  if (values.size() != tuples * static_cast<std::size_t>(given)) {
    throw InternalError(fmt::format("result field '{}' has {} numbers for {} x {} of the mesh",
                                    name, values.size(), tuples, given));
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  array->Fill(0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto each = static_cast<std::size_t>(given);
    array->SetComponent(static_cast<vtkIdType>(i / each), static_cast<int>(i % each), values[i]);
  }
  return array;
}

void name_components(const std::vector<std::string>& names, vtkDoubleArray& array) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    array.SetComponentName(static_cast<vtkIdType>(c), names[c].c_str());
  }
}

void add_node_fields(const std::vector<NodeField>& fields, int dim, std::size_t num_nodes,
                     vtkUnstructuredGrid& grid) {
  for (const NodeField& field : fields) {
    const int given = field.components > 0 ? field.components : dim;
    const vtkNew<vtkDoubleArray> array =
        double_array(field.name, field.values, given, field.components > 0 ? given : 3, num_nodes);
    name_components(field.component_names, *array);
    grid.GetPointData()->AddArray(array);
  }
}

void add_labels(const ElementLabels& labels, std::size_t num_elements, vtkUnstructuredGrid& grid) {
  if (labels.values.size() != num_elements) {
    throw InternalError(fmt::format("result field '{}' has {} numbers for {} elements", labels.name,
                                    labels.values.size(), num_elements));
  }
  vtkNew<vtkIntArray> array;
  array->SetName(labels.name.c_str());
  for (const std::int32_t value : labels.values) array->InsertNextValue(value);
  grid.GetCellData()->AddArray(array);

  // Bytes: readers other than VTK's refuse files with strings.
  vtkNew<vtkUnsignedCharArray> names;
  names->SetName((labels.name + "_names").c_str());
  for (const std::string& name : labels.names) {
    for (const char c : name + "\n") names->InsertNextValue(static_cast<unsigned char>(c));
  }
  grid.GetFieldData()->AddArray(names);
}

void write_grid(const std::filesystem::path& file, vtkUnstructuredGrid& grid) {
  // Through memory: a writer that opens files itself prints its troubles instead of telling them.
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->WriteToOutputStringOn();
  // The numbers as they are (docs/decisions/0020): meshio does not read LZ4, zlib takes longer than
  // the step that is written.
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  if (grid.GetCells()->GetNumberOfConnectivityIds() <= std::numeric_limits<std::int32_t>::max()) {
    writer->SetIdTypeToInt32();
  }
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (writer->Write() != 1) {
    throw WorkError(fmt::format("{}: VTK cannot write this mesh", file.string()));
  }
  write_text_file(file, writer->GetOutputString());
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const Mesh& mesh, const VtuFields& fields) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.num_nodes()));
  for (std::size_t i = 0; i < mesh.num_nodes(); ++i) {
    const std::span<const double> at(&mesh.positions[dim * i], dim);
    points->SetPoint(static_cast<vtkIdType>(i), at[0], at[1], dim == 3 ? at[2] : 0.0);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  add_cells(mesh, *grid);
  add_node_fields(fields.nodes, mesh.dim, mesh.num_nodes(), *grid);
  for (const ElementField& field : fields.elements) {
    const vtkNew<vtkDoubleArray> array = double_array(field.name, field.values, field.components,
                                                      field.components, mesh.num_elements());
    name_components(field.component_names, *array);
    grid->GetCellData()->AddArray(array);
  }
  for (const ElementLabels& labels : fields.labels) {
    add_labels(labels, mesh.num_elements(), *grid);
  }
  write_grid(file, *grid);
}

void write_points_vtu(const std::filesystem::path& file, std::span<const double> positions,
                      const std::vector<NodeField>& fields) {
  const std::size_t count = positions.size() / 3;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  vtkNew<vtkUnstructuredGrid> grid;
  grid->Allocate(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto point = static_cast<vtkIdType>(i);
    points->SetPoint(point, &positions[3 * i]);
    grid->InsertNextCell(VTK_VERTEX, 1, &point);
  }
  grid->SetPoints(points);
  add_node_fields(fields, 3, count, *grid);
  write_grid(file, *grid);
}

}  // namespace elastogen::selector
