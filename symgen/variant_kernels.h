// The kernels of one geometry variant: what every operation computes, and how operations on points
// make those on elements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symgen/emit/kernel_ast.h"
#include "symgen/mechanics/element_graph.h"

namespace elastogen::symgen {

/// A value graph with where each root goes: output[outputs[k]] += roots[k].
struct Piece {
  std::vector<NodeId> roots;
  std::vector<int> outputs;
  std::vector<NodeId> margins = {};  ///< positive where the law is defined
};

/// One operation: fragments that accumulate into its outputs.
struct OperationKernels {
  std::string name;
  int num_outputs = 0;
  std::vector<Piece> pieces;        ///< in VariantKernels::dag
  std::vector<Fragment> fragments;  ///< one per piece
  /// The one fragment in steps, if it waits for functions.
  std::optional<Steps> steps = std::nullopt;
};

/// Everything that a piece computes, margins last.
[[nodiscard]] std::vector<NodeId> values_of(const Piece& piece);

/// Makes an operation's fragments of its pieces.
/// @param in_steps  also in steps, where it is one piece that waits for functions
void schedule(OperationKernels& operation, const Dag& dag, const Inputs& inputs, bool in_steps);

/// Whether an operation gives nodal values: forces, product, apply.
[[nodiscard]] bool is_nodal(const std::string& operation);
/// Whether an operation takes weights of points for a direction.
[[nodiscard]] bool reads_weights(const std::string& operation);
/// Whether an operation depends on an input array.
[[nodiscard]] bool reads(const OperationKernels& operation, Slot slot);

/// How operations on one quadrature point make those on an element. Each takes gradients in
/// reference coordinates instead of nodal values, and gives fluxes instead of nodal forces:
///   energy                     interpolate, each point, weigh
///   forces, product, apply     interpolate, each point, integrate
///   linearize, stress          interpolate, each point; of stress the direction is its weight
///   constants                  Jacobians, each point, or once if these are the same
struct PointLoop {
  std::vector<NumberId> weights;  ///< of the points
  bool is_affine = false;         ///< Jacobians and constants are the same at all points
  /// Gradients at all points of a nodal field (Slot::displacement), [(g * dim + i) * dim + k].
  OperationKernels interpolate;
  /// Nodal values of weighted fluxes at all points (Slot::displacement, likewise): the transpose.
  OperationKernels integrate;
  /// The energy of densities at all points (Slot::displacement).
  OperationKernels weigh;
  /// The Jacobian [i * dim + k] from positions, if affine; else it is interpolated from them.
  OperationKernels jacobian;
  /// The weights as an array, for stress.
  OperationKernels point_weights;
};

/// All operations of one geometry variant of an association.
struct VariantKernels {
  Geometry geometry = Geometry::general;
  int num_nodes = 0, dim = 0, num_points = 0;
  Dag dag;                        ///< after all passes
  std::vector<NodeId> constants;  ///< stored grouped constants, in the order of their storage
  int constants_algorithm6 = 0;   ///< what algorithm 6 stores
  int num_state = 0;
  bool reads_positions = false;  ///< energy ... stiffness read rest positions; stress always does
  /// constants, geometry, energy, forces, product, linearize, apply, stress, in this order
  std::vector<OperationKernels> operations;
  /// If set, operations (but not geometry), constants and state are those of one point.
  std::optional<PointLoop> loop;

  /// Of an operation, per element.
  [[nodiscard]] OperationCount operations_of(const std::string& name) const;
  [[nodiscard]] long flops(const std::string& name) const { return operations_of(name).flops(); }
  /// Numbers that an operation of an element computes.
  [[nodiscard]] int num_outputs(const OperationKernels& operation) const;
  /// How often an element stores the constants: for each point of a loop, or once.
  [[nodiscard]] int num_constant_sets() const;
  /// Numbers that one element stores.
  [[nodiscard]] int num_stored_constants() const;
  [[nodiscard]] int num_stored_state() const;

  [[nodiscard]] const OperationKernels& operation(const std::string& name) const;
};

}  // namespace elastogen::symgen
