// elastogen-vtk FILE RECORD [ARRAY]: reads a legacy (.vtk) or XML (.vtu) unstructured grid with
// VTK's readers and writes what it found (raw_mesh.h). A program of its own, as elastogen-gmsh is:
// what a damaged file does to a library ends this process at most.
// ARRAY names the integer cell array whose values are the groups; without it, the first of
// `known_arrays` that there is.
// Exit status 0: RECORD is written; 1: not, and the reason stands on standard output.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTypes.h>
#include <vtkDataSetReader.h>
#include <vtkFieldData.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkVersion.h>
#include <vtkXMLFileReadTester.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "selector/mesh_readers/raw_mesh.h"
#include "selector/mesh_readers/vtk_cells.h"

namespace {

using elastogen::selector::find_vtk_cell_type;
using elastogen::selector::RawElements;
using elastogen::selector::RawMesh;
using elastogen::selector::VtkCellType;

/// Why a file cannot be read.
using Refusal = std::runtime_error;

/// What groups are called in files of this program, gmsh's through meshio, Medit's through meshio,
/// and by VTK, ParaView and gmsh.
constexpr const char* known_arrays[] = {"region",      "gmsh:physical", "medit:ref",
                                        "MaterialIds", "RegionId",      "CellEntityIds"};

/// VTK's complaint without its place in VTK's source.
std::string complaint(const char* text) {
  std::string line = text;
  if (const std::size_t place = line.find('\n'); line.find(": In ") < place) {
    line.erase(0, std::min(place, line.size() - 1) + 1);
  }
  const std::size_t object = line.find("): ");
  if (object != std::string::npos) line.erase(0, object + 3);
  for (char& c : line) c = c == '\n' ? ' ' : c;
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

/// Takes errors and warnings of VTK, instead of the terminal.
class Complaints final : public vtkOutputWindow {
 public:
  vtkTypeMacro(Complaints, vtkOutputWindow);
  static Complaints* New();
  void DisplayErrorText(const char* text) override { errors.push_back(complaint(text)); }
  /// The legacy reader only warns where data end too early.
  void DisplayWarningText(const char* text) override {
    const std::string warning = complaint(text);
    (warning.starts_with("Error") ? errors : warnings).push_back(warning);
  }
  void DisplayGenericWarningText(const char* text) override { DisplayWarningText(text); }
  void DisplayText(const char* /*text*/) override {}

  std::vector<std::string> errors, warnings;
};
vtkStandardNewMacro(Complaints);

void read_with(vtkUnstructuredGridReader& reader, const std::string& file) {
  reader.SetFileName(file.c_str());
  if (reader.IsFileUnstructuredGrid() != 0) {
    reader.ReadAllScalarsOn();
    reader.ReadAllFieldsOn();
    reader.Update();
    return;
  }
  vtkNew<vtkDataSetReader> any;
  any->SetFileName(file.c_str());
  const int type = any->ReadOutputType();
  if (type < 0) throw Refusal("it ends before it names its dataset");
  throw Refusal(fmt::format(
      "it holds a {}, not an unstructured grid: convert it (ParaView: Append Datasets, then save "
      "as .vtu; pyvista: cast_to_unstructured_grid)",
      vtkDataObjectTypes::GetClassNameFromTypeId(type)));
}

void read_with(vtkXMLUnstructuredGridReader& reader, const std::string& file) {
  reader.SetFileName(file.c_str());
  if (reader.CanReadFile(file.c_str()) != 0) {
    reader.Update();
    return;
  }
  vtkNew<vtkXMLFileReadTester> tester;
  tester->SetFileName(file.c_str());
  if (tester->TestReadFile() == 0 || tester->GetFileDataType() == nullptr) {
    throw Refusal("it is neither a legacy file of VTK ('# vtk DataFile') nor a sound XML file");
  }
  throw Refusal(fmt::format(
      "it holds '{}' of version {}, which is not an UnstructuredGrid that VTK {} reads: save it as "
      "an unstructured grid (ParaView: Append Datasets)",
      tester->GetFileDataType(),
      tester->GetFileVersion() == nullptr ? "?" : tester->GetFileVersion(),
      vtkVersion::GetVTKVersion()));
}

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& file) {
  vtkNew<Reader> reader;
  read_with(*reader, file);
  return reader->GetOutput();
}

/// What a reader leaves unchecked.
void check(vtkUnstructuredGrid& grid) {
  vtkCellArray* cells = grid.GetCells();
  const vtkIdType count = grid.GetNumberOfCells();
  if (cells == nullptr || count == 0) {
    throw Refusal(
        fmt::format("it has {} points and no cells: they were not written, or it is cut "
                    "short",
                    grid.GetNumberOfPoints()));
  }
  if (!cells->IsValid()) throw Refusal("it is damaged: the offsets of its cells do not ascend");
  if (grid.GetCellTypesArray()->GetNumberOfValues() != count) {
    throw Refusal(fmt::format("it is damaged: it has {} cells and {} cell types", count,
                              grid.GetCellTypesArray()->GetNumberOfValues()));
  }
}

/// The group of each cell; empty where there are none.
class Labels {
 public:
  Labels(vtkUnstructuredGrid& grid, const std::string& wanted) {
    vtkCellData* data = grid.GetCellData();
    if (!wanted.empty()) {
      array_ = data->GetArray(wanted.c_str());
      if (array_ == nullptr) {
        throw Refusal(fmt::format("it has no cell array '{}' (regions in [mesh]); it has: {}",
                                  wanted, names_of_arrays(*data)));
      }
      if (!is_of_integers(grid.GetNumberOfCells())) {
        throw Refusal(
            fmt::format("its cell array '{}' (regions in [mesh]) has values that are not "
                        "integers, one for each cell",
                        wanted));
      }
    }
    for (const char* name : known_arrays) {
      if (array_ != nullptr) break;
      array_ = data->GetArray(name);
      if (array_ != nullptr && !is_of_integers(grid.GetNumberOfCells())) array_ = nullptr;
    }
    if (array_ != nullptr) read_names(*grid.GetFieldData());
  }

  [[nodiscard]] bool empty() const { return array_ == nullptr; }
  [[nodiscard]] std::int32_t number(vtkIdType cell) const {
    return static_cast<std::int32_t>(array_->GetComponent(cell, 0));
  }
  [[nodiscard]] std::string name(std::int32_t number) const {
    const auto at = static_cast<std::size_t>(number);
    return number >= 0 && at < names_.size() ? names_[at] : "";
  }

 private:
  static std::string names_of_arrays(vtkCellData& data) {
    std::string names;
    for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
      if (data.GetArrayName(i) == nullptr) continue;
      names += (names.empty() ? "'" : ", '") + std::string(data.GetArrayName(i)) + "'";
    }
    return names.empty() ? "none" : names;
  }

  [[nodiscard]] bool is_of_integers(vtkIdType count) const {
    if (array_->GetNumberOfComponents() != 1 || array_->GetNumberOfTuples() != count) return false;
    for (vtkIdType cell = 0; cell < count; ++cell) {
      const double value = array_->GetComponent(cell, 0);
      if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) {
        return false;
      }
    }
    return true;
  }

  /// As vtu.h says: the field data NAME_names is bytes, one line for each value; in files of
  /// earlier versions strings.
  void read_names(vtkFieldData& fields) {
    const std::string name = std::string(array_->GetName()) + "_names";
    vtkAbstractArray* found = fields.GetAbstractArray(name.c_str());
    if (auto* strings = vtkStringArray::SafeDownCast(found); strings != nullptr) {
      for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i) {
        names_.push_back(strings->GetValue(i));
      }
    } else if (auto* bytes = vtkUnsignedCharArray::SafeDownCast(found); bytes != nullptr) {
      std::string line;
      for (vtkIdType i = 0; i < bytes->GetNumberOfValues(); ++i) {
        const char c = static_cast<char>(bytes->GetValue(i));
        if (c != '\n') {
          line += c;
          continue;
        }
        names_.push_back(std::move(line));
        line.clear();
      }
    }
  }

  vtkDataArray* array_ = nullptr;
  std::vector<std::string> names_;
};

void add_points(vtkUnstructuredGrid& grid, RawMesh& mesh) {
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    mesh.node_numbers.push_back(static_cast<std::uint64_t>(i));
    const double* at = grid.GetPoint(i);
    mesh.coordinates.insert(mesh.coordinates.end(), at, at + 3);
  }
}

/// An empty list for cells of a type, with one of them.
RawElements list_for(vtkUnstructuredGrid& grid, vtkIdType id, const VtkCellType& type) {
  const int number = grid.GetCellType(id);
  const vtkIdType size = grid.GetCells()->GetCellSize(id);
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(number));
  if (cell == nullptr) {
    throw Refusal(fmt::format("cell {} is of type {}, which is none of VTK's", id, number));
  }
  RawElements elements;
  elements.dim = cell->GetCellDimension();
  elements.element = type.element;
  elements.type_name = vtkCellTypes::GetClassNameFromTypeId(number);
  elements.nodes_per_element = static_cast<std::int32_t>(size);
  if (!type.element.empty() && type.order.size() != static_cast<std::size_t>(size)) {
    throw Refusal(fmt::format("it is damaged: cell {} ({}) has {} points instead of {}", id,
                              elements.type_name, size, type.order.size()));
  }
  return elements;
}

void add_cells(vtkUnstructuredGrid& grid, const Labels& labels, RawMesh& mesh) {
  std::map<int, VtkCellType> types;
  std::map<std::pair<int, std::int32_t>, std::int32_t> group_of;  // dimension and value
  std::map<std::array<std::int64_t, 3>, std::size_t> list_of;     // type, points, value
  vtkNew<vtkIdList> points;
  for (vtkIdType id = 0; id < grid.GetNumberOfCells(); ++id) {
    const int number = grid.GetCellType(id);
    if (number == VTK_EMPTY_CELL) continue;
    const VtkCellType& type = types.try_emplace(number, find_vtk_cell_type(number)).first->second;
    const std::int32_t label = labels.empty() ? 0 : labels.number(id);
    const auto [entry, is_new] = list_of.emplace(
        std::array<std::int64_t, 3>{number, grid.GetCells()->GetCellSize(id), label},
        mesh.elements.size());
    if (is_new) {
      RawElements elements = list_for(grid, id, type);
      if (!labels.empty()) {
        const auto [group, is_new_group] = group_of.emplace(
            std::pair(elements.dim, label), static_cast<std::int32_t>(mesh.groups.size()));
        if (is_new_group) mesh.groups.push_back({elements.dim, label, labels.name(label)});
        elements.groups = {group->second};
      }
      mesh.elements.push_back(std::move(elements));
    }
    RawElements& elements = mesh.elements[entry->second];
    grid.GetCells()->GetCellAtId(id, points);
    elements.numbers.push_back(static_cast<std::uint64_t>(id));
    for (vtkIdType a = 0; a < points->GetNumberOfIds(); ++a) {
      const vtkIdType point =
          points->GetId(type.element.empty() ? a : type.order[static_cast<std::size_t>(a)]);
      if (point < 0 || point >= grid.GetNumberOfPoints()) {
        throw Refusal(
            fmt::format("it is damaged: cell {} has the point {}: they are numbered from "
                        "0 to {}",
                        id, point, grid.GetNumberOfPoints() - 1));
      }
      elements.nodes.push_back(static_cast<std::uint64_t>(point));
    }
  }
}

/// Values on edges and vertices of a solid are numbers of another kind than those on its faces
/// (gmsh counts the entities of each dimension from 1), and would be mixed up with them.
void drop_lower_groups(RawMesh& mesh) {
  std::int32_t body_dim = 0;
  for (const RawElements& elements : mesh.elements) body_dim = std::max(body_dim, elements.dim);
  for (RawElements& elements : mesh.elements) {
    if (elements.dim < body_dim - 1) elements.groups.clear();
  }
}

RawMesh read_mesh(const std::string& file, const std::string& array) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  const auto complaints = vtkSmartPointer<Complaints>::New();
  vtkOutputWindow::SetInstance(complaints);
  std::ifstream stream(file, std::ios::binary);
  std::string start(5, ' ');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  const vtkSmartPointer<vtkUnstructuredGrid> grid =
      start == "# vtk" ? read_grid<vtkUnstructuredGridReader>(file)
                       : read_grid<vtkXMLUnstructuredGridReader>(file);
  if (!complaints->errors.empty()) {
    throw Refusal("it is damaged, or cut short: VTK says: " + complaints->errors.front());
  }
  check(*grid);
  RawMesh mesh;
  for (const std::string& warning : complaints->warnings) mesh.notes.push_back("VTK: " + warning);
  const Labels labels(*grid, array);
  add_points(*grid, mesh);
  add_cells(*grid, labels, mesh);
  drop_lower_groups(mesh);
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::printf("usage: elastogen-vtk FILE RECORD [ARRAY]");
    return 1;
  }
  try {
    const RawMesh mesh = read_mesh(argv[1], argc == 4 ? argv[3] : "");
    const std::string bytes = elastogen::selector::pack(mesh);
    std::ofstream record(argv[2], std::ios::binary);
    record << bytes << std::flush;
    if (!record) throw Refusal("the record cannot be written");
    return 0;
  } catch (const std::exception& error) {
    std::printf("%s", error.what());
    return 1;
  }
}
