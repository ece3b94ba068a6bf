// From an element's energies to the fragments of every operation: derivatives and passes in order.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "symgen/emit/kernel_ast.h"
#include "symgen/mechanics/element_graph.h"
#include "symgen/passes/profile.h"
#include "symgen/passes/split.h"
#include "symgen/pipeline.h"
#include "symgen/stage_log.h"

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
  std::vector<Piece> pieces;        ///< in VariantKernels::dag, before scheduling
  std::vector<Fragment> fragments;  ///< one per piece
};

/// All operations of one geometry variant of an association.
struct VariantKernels {
  Geometry geometry = Geometry::general;
  int num_nodes = 0, dim = 0, num_points = 0;
  Dag dag;                        ///< after all passes
  std::vector<NodeId> constants;  ///< stored grouped constants, in the order of their storage
  int constants_algorithm6 = 0;   ///< what algorithm 6 stores
  int num_state = 0;
  bool reads_positions = false;  ///< energy ... stiffness read rest positions
  /// constants, geometry, energy, forces, product, linearize, apply, in this order
  std::vector<OperationKernels> operations;

  [[nodiscard]] const OperationKernels& operation(const std::string& name) const;
};

/// The stages after mechanics, in order. `graph` is the element's; it is copied.
/// @param log  gets a record of each stage
[[nodiscard]] VariantKernels build_kernels(ElementGraph graph, Geometry geometry,
                                           const Split& split, const Profile& profile,
                                           Grouping grouping, StageLog& log);

/// Energy, forces and product as they come from mechanics, without any pass: the reference.
[[nodiscard]] VariantKernels unoptimised_kernels(ElementGraph graph);

/// The same from the thesis's polynomials, every monomial written out.
[[nodiscard]] VariantKernels expanded_kernels(ElementGraph graph);

/// Flops of the largest kind of fragment that a split makes, by the product, the dearest operation
/// (what is known at rest not counted). Made from one Gauss point and one row part, since the
/// others are alike; `auto` compares it with the profile's limit.
[[nodiscard]] long typical_fragment_flops(ElementGraph graph, const Split& split);

}  // namespace elastogen::symgen
