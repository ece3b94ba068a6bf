// From quadrature points to nodes: what elements know at their points, such as stress, as a field
// that is continuous from element to element.
//
// Both ways begin in each element by itself: a linear function of the rest position is fitted to
// the values at its points by least squares, weighted by their volumes (where the points are too
// few for one, a constant: their mean). Then
//
//   average    value of a node = mean of its elements' functions there, weighted by their volumes
//   project    the field of the elements' shape functions that is nearest to the elements'
//              functions f in the mean square: M v = b, M_ab = integral of Lambda_a Lambda_b,
//              b_a = integral of Lambda_a f, over the rest shape
//
// The first is the local, the second the global smoothing of Hinton & Campbell, Int. J. Numer.
// Methods Eng. 8 (1974) 461-480. Both leave a linear field as it is, on every mesh whose elements
// have points enough for it. M is solved by conjugate gradient with its diagonal: its condition
// number does not depend on the mesh then (Wathen, IMA J. Numer. Anal. 7 (1987) 449-457).
//
// Stress jumps where the material does, so neither goes beyond a zone: the elements that have one
// material. A node between two zones has a value in each.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/model.h"
#include "runtime/stress.h"

namespace elastogen {

/// Values have a width, the number of quantities that are recovered together:
///   of points   value[point * width + k]   points as in StressField
///   of slots    value[slot * width + k]
///   of nodes    value[node * width + k]
/// A slot is a node in one of its zones. What is not finite at a point stays so: in all nodes of
/// its element, of project() in all of its zone.
class NodalRecovery {
 public:
  /// @param parts  as the model's; their kernels tell where points are
  /// @param zones  [part]: numbers from 0; elements of parts with one number share nodes' values
  /// @throws InternalError  kernels without points
  NodalRecovery(const Mesh& mesh, std::span<const ModelPart> parts, std::span<const int> zones);

  [[nodiscard]] std::size_t num_slots() const { return nodes_.size(); }
  [[nodiscard]] std::span<const std::int32_t> nodes() const { return nodes_; }  ///< [slot]
  /// The slots of an element's nodes, in its order.
  [[nodiscard]] std::span<const std::int32_t> element_slots(std::size_t element) const;

  /// Values of slots from those of points.
  [[nodiscard]] std::vector<double> average(std::span<const double> values, int width) const;
  /// Likewise. The matrix is made at the first call.
  /// @throws WorkError  when conjugate gradient does not converge
  [[nodiscard]] std::vector<double> project(std::span<const double> values, int width);

  /// One value per node: the mean of its slots, weighted by the volumes of their elements.
  [[nodiscard]] std::vector<double> joined(std::span<const double> slot_values, int width) const;

  /// Rest positions of the points in space [3 * point + i]; of a plane mesh with a last 0.
  [[nodiscard]] std::vector<double> point_positions() const;
  /// Values of points from those of the mesh's nodes, by the shape functions.
  [[nodiscard]] std::vector<double> at_points(std::span<const double> node_values, int width) const;

 private:
  struct Element;
  void make_mass_matrix();

  int dim_;
  std::size_t num_nodes_;
  std::vector<double> positions_;                   // [dim * node + i]
  std::vector<const KernelTable<double>*> tables_;  // [element]
  std::vector<std::size_t> first_slot_;             // [element]: into slots_
  std::vector<std::size_t> first_point_;            // [element]
  std::vector<std::int32_t> slots_;                 // of each element's nodes
  std::vector<std::int32_t> nodes_;                 // [slot]
  std::vector<int> zones_;                          // [slot]
  std::vector<double> volumes_;                     // [slot]: of its elements
  Eigen::SparseMatrix<double> mass_;                // empty until needed
};

}  // namespace elastogen
