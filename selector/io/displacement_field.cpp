#include "selector/io/displacement_field.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/error.h"

namespace elastogen::selector {
namespace {

/// How far outside a cell a point may lie, as a part of the body's size: rounding.
constexpr double tolerance = 1e-9;

/// A file's cells and their point data "displacement".
struct ResultGrid {
  explicit ResultGrid(const std::filesystem::path& file) {
    reader->SetFileName(file.c_str());
    if (!std::filesystem::is_regular_file(file) || !reader->CanReadFile(file.c_str())) {
      throw InputError(fmt::format("{}: is no VTU file that can be read", file.string()));
    }
    reader->Update();
    grid = reader->GetOutput();
    displacement = grid->GetPointData()->GetArray("displacement");
    if (!displacement || displacement->GetNumberOfComponents() != 3 ||
        grid->GetNumberOfCells() == 0) {
      throw InputError(
          fmt::format("{}: has no cells with the point data 'displacement'", file.string()));
    }
  }

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkUnstructuredGrid* grid = nullptr;
  vtkDataArray* displacement = nullptr;
};

/// VTK finds local coordinates in quadratic cells to 1e-4 or so: Newton's method goes on from them.
/// @param weights  gets the shape functions there, [node]
void improve_local_coordinates(vtkGenericCell& cell, const Eigen::Vector3d& at,
                               std::array<double, 3>& local, std::vector<double>& weights) {
  const auto count = static_cast<Eigen::Index>(cell.GetNumberOfPoints());
  Eigen::Matrix3Xd points(3, count);
  for (Eigen::Index n = 0; n < count; ++n) {
    points.col(n) = Eigen::Map<const Eigen::Vector3d>(cell.GetPoints()->GetPoint(n));
  }
  Eigen::MatrixX3d slopes(count, 3);  // by columns, as VTK lists them
  for (int iteration = 0; iteration < 4; ++iteration) {
    cell.InterpolateFunctions(local.data(), weights.data());
    cell.InterpolateDerivs(local.data(), slopes.data());
    const Eigen::Vector3d residual =
        at - points * Eigen::Map<const Eigen::VectorXd>(weights.data(), count);
    Eigen::Map<Eigen::Vector3d>(local.data()) +=
        (points * slopes).partialPivLu().solve(residual).eval();
  }
  cell.InterpolateFunctions(local.data(), weights.data());
}

}  // namespace

ResultField read_result_field(const std::filesystem::path& file) {
  const ResultGrid result(file);
  ResultField field;
  for (vtkIdType node = 0; node < result.grid->GetNumberOfPoints(); ++node) {
    std::array<double, 3> at{};
    result.grid->GetPoint(node, at.data());
    field.positions.insert(field.positions.end(), at.begin(), at.end());
    result.displacement->GetTuple(node, at.data());
    field.displacements.insert(field.displacements.end(), at.begin(), at.end());
  }
  return field;
}

std::vector<double> displacements_at(const std::filesystem::path& file,
                                     std::span<const double> positions, int dim) {
  const ResultGrid field(file);
  vtkUnstructuredGrid* const grid = field.grid;
  vtkDataArray* const displacement = field.displacement;
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(grid);
  locator->BuildLocator();

  const auto each = static_cast<std::size_t>(dim);
  const double size = grid->GetLength();
  std::vector<double> result(positions.size(), 0.0);
  vtkNew<vtkGenericCell> cell;
  std::vector<double> weights(static_cast<std::size_t>(grid->GetMaxCellSize()));
  for (std::size_t p = 0; p < positions.size() / each; ++p) {
    std::array<double, 3> at{}, local{};
    std::copy_n(&positions[each * p], each, at.begin());
    const vtkIdType found = locator->FindCell(at.data(), tolerance * size * tolerance * size, cell,
                                              local.data(), weights.data());
    if (found < 0) {
      throw InputError(
          fmt::format("{}: the point [{}] lies in none of its cells: the bodies differ",
                      file.string(), fmt::join(at, ", ")));
    }
    if (cell->IsLinear() == 0 && cell->GetCellDimension() == 3) {
      improve_local_coordinates(*cell, Eigen::Map<const Eigen::Vector3d>(at.data()), local,
                                weights);
    }
    for (vtkIdType n = 0; n < cell->GetNumberOfPoints(); ++n) {
      for (std::size_t c = 0; c < each; ++c) {
        result[each * p + c] +=
            weights[static_cast<std::size_t>(n)] *
            displacement->GetComponent(cell->GetPointId(n), static_cast<int>(c));
      }
    }
  }
  return result;
}

FieldDistance field_distance(std::span<const double> values, std::span<const double> reference,
                             int dim) {
  const auto each = static_cast<std::size_t>(dim);
  const std::size_t count = values.size() / each;
  FieldDistance distance{0, INFINITY, 0};
  for (std::size_t p = 0; p < count; ++p) {
    double square = 0;
    for (std::size_t c = 0; c < each; ++c) {
      square += std::pow(values[each * p + c] - reference[each * p + c], 2);
    }
    distance.mean += std::sqrt(square) / static_cast<double>(count);
    distance.minimum = std::min(distance.minimum, std::sqrt(square));
    distance.maximum = std::max(distance.maximum, std::sqrt(square));
  }
  return distance;
}

}  // namespace elastogen::selector
