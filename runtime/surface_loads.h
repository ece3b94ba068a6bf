// Dead loads on parts of a body's surface, as consistent nodal forces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/vector.h"

namespace elastogen {

/// A face of an element on the body's surface: global node numbers, counter-clockwise seen from
/// outside. A triangle or a bilinear quadrilateral; with nodes in the middle of their edges after
/// the corners (01 12 ... and back) a quadratic triangle or serendipity quadrilateral; of a plane
/// body an edge of two nodes, the body on its left, for a metre of thickness.
using SurfaceFace = std::vector<std::int32_t>;

/// f += the forces of a pressure on the rest surface, f_a = -p integral of N_a n dA with the
/// outward normal n. It is a dead load: it keeps the direction and the area of the rest surface,
/// whatever the deformation. Exact, also on warped and curved faces: the forces of a closed surface
/// add up to 0.
///
/// @param pressure  [Pa], finite; positive presses against the body
/// @param f         [dim * node + component], N
/// @throws InputError  a pressure that is not finite, a face with a node outside the mesh or with
///                     another number of nodes
void add_pressure(const Mesh& mesh, std::span<const SurfaceFace> faces, double pressure,
                  VectorRef f);

/// f += the forces of a traction on the rest surface, f_a = t integral of N_a dA; a dead load.
/// Exact on flat faces; on warped and curved ones the area is that of face_points' rule.
///
/// @param traction  force per area of the rest surface [Pa], dim finite components
/// @throws InputError  as add_pressure
void add_traction(const Mesh& mesh, std::span<const SurfaceFace> faces,
                  std::span<const double> traction, VectorRef f);

/// Area of the rest surface [m^2], by the rule of add_traction; of a plane body for a metre of
/// thickness.
[[nodiscard]] double surface_area(const Mesh& mesh, std::span<const SurfaceFace> faces);

}  // namespace elastogen
