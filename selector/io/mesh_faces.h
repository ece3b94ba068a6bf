// Faces of a mesh: which are on its surface, and where elements do not fit together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// A face of one element; in the plane an edge.
struct MeshFace {
  std::size_t block = 0;            ///< index into Mesh::blocks
  std::size_t element = 0;          ///< number within the block
  std::size_t face = 0;             ///< index into ElementTopology::faces
  std::vector<std::int32_t> nodes;  ///< global, in the order of ElementTopology::faces
};

/// How the faces of a mesh match.
struct FaceMatching {
  /// Faces of a single element: the surface, and both sides of interfaces that do not conform.
  std::vector<MeshFace> boundary;
  /// One face of every set of nodes that more than two elements share: elements overlap there.
  std::vector<MeshFace> overused;
  /// Indices into `boundary` of quadrilaterals whose four corners also carry two boundary triangles
  /// of other elements: the displacement is not continuous across them (thesis, figure 6.19).
  std::vector<std::size_t> split_quadrilaterals;
  /// Indices into `boundary` of faces that have the same corners as another, but not the same nodes
  /// in the middle of the edges: linear elements beside quadratic ones, or such nodes not shared.
  /// The displacement is not continuous across them.
  std::vector<std::size_t> unequal;
};

/// Matches faces by their sets of nodes. Deterministic: faces come in element order.
[[nodiscard]] FaceMatching match_faces(const Mesh& mesh);

/// Indices into `matching.boundary` of the faces on the mesh's surface: `boundary` without the
/// faces that meet in non-conforming interfaces.
[[nodiscard]] std::vector<std::size_t> surface_faces(const FaceMatching& matching);

}  // namespace elastogen::selector
