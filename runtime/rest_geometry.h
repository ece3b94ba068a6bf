// Rest shapes: which geometry variant an element may use, and whether it is sound.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/mesh.h"
#include "runtime/node_numbering.h"

namespace elastogen {

/// If an element's rest shape is an axis-aligned box, to 1e-12 of its longest edge, or in the plane
/// a rectangle: which of its nodes lie at the corners (0,0,0) (1,0,0) (1,1,0) (0,1,0), then the
/// same at z = 1, the order of hexa8 and quad4, then in the middle of the edges, the order of
/// hexa20. The element's own order may be turned against that, as mesh generators do. Empty for
/// other shapes, inverted ones, and elements of other types.
[[nodiscard]] std::vector<int> box_node_order(const Mesh& mesh, const ElementBlock& block,
                                              std::size_t element);

/// Whether an element is a tet10 whose edges are straight, with their nodes in the middle to 1e-12
/// of the longest: its map from the reference shape is affine then.
[[nodiscard]] bool has_straight_edges(const Mesh& mesh, const ElementBlock& block,
                                      std::size_t element);

/// The order that an element's nodes must have for a geometry variant, empty: the one they have.
/// Nothing where its rest shape is not of that geometry.
[[nodiscard]] std::optional<std::vector<int>> node_order_for(const std::string& geometry,
                                                             const Mesh& mesh,
                                                             const ElementBlock& block,
                                                             std::size_t element);

/// The variant of a table for a geometry, or null.
template <class Scalar>
[[nodiscard]] const VariantTable<Scalar>* find_variant(const KernelTable<Scalar>& table,
                                                       const std::string& geometry);

/// What the kernel `geometry_measures` tells of a group.
struct RestMeasures {
  std::span<double> nodal_volumes;    ///< [node], added to
  std::span<double> nodal_mass;       ///< [node], density times nodal volume, added to
  std::span<double> lumped_mass;      ///< [node], density times positive share, added to
  std::span<double> element_volumes;  ///< [element in the mesh]
};

/// Fills the measures from the group's positions.
/// @param mesh  that the group is of, in whose numbers it is
/// @throws InputError  naming the group's first element whose Jacobian determinant is not above
///                     rounding at a quadrature point
void measure_rest_shapes(const ElementGroup<double>& group, const Mesh& mesh,
                         RestMeasures measures);

/// "element 17 (tet4, nodes 3 8 9 12)", lane `k` of the group; the mesh's numbers, from 0.
template <class Scalar>
[[nodiscard]] std::string element_text(const ElementGroup<Scalar>& group,
                                       const NodeNumbering& numbering, std::size_t k);

}  // namespace elastogen
