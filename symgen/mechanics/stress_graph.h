// What the operation `stress` gives at quadrature points, as graphs of an element's inputs.
#pragma once

#include <memory>
#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/element/element.h"
#include "symgen/mechanics/derivation.h"
#include "symgen/mechanics/energy.h"
#include "symgen/mechanics/rest_shape.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::symgen {

/// Displacement gradient, first Piola-Kirchhoff stress, energy density and rest volume of points.
struct StressGraph {
  Dag dag;
  std::vector<NodeId> positions, parameters, displacement;  ///< inputs, as ElementGraph's
  std::vector<NodeId> weight;                ///< of any one point: an input; else empty
  std::vector<std::vector<NodeId>> points;   ///< [g][k], k < stress_numbers of runtime/kernel_abi.h
  std::vector<std::vector<NodeId>> margins;  ///< [g]: positive where the law is defined
};

/// How a law's energy is written and derived for it.
struct StressOptions {
  EnergyOptions energy;
  Derivation derivation = Derivation::dag;
};

/// P = dW/dH by all nine entries of H in space, into which the element's displacement gradient is
/// put: in plane strain, whose H has a last row and column of zero, this gives P_33.
/// @param numbers  of the graph
[[nodiscard]] StressGraph build_stress_graph(const Law& law, const Element& element,
                                             const Quadrature& quadrature, Geometry geometry,
                                             const StressOptions& options,
                                             std::shared_ptr<NumberPool> numbers);

/// Any one point, of its weight and, in place of positions and displacement, their gradients in
/// reference coordinates.
[[nodiscard]] StressGraph build_pointwise_stress_graph(const Law& law, const Element& element,
                                                       const Quadrature& quadrature,
                                                       Geometry geometry,
                                                       const StressOptions& options,
                                                       std::shared_ptr<NumberPool> numbers);

}  // namespace elastogen::symgen
