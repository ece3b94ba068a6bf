// Quadrature points of element faces, with which loads on surfaces are integrated.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace elastogen {

using FacePosition = std::array<double, 3>;  ///< [m]

inline constexpr std::size_t most_face_nodes = 8;

/// A quadrature point of a face: its shape functions, and the area vector that it stands for.
struct FacePoint {
  std::array<double, most_face_nodes> shape{};  ///< [node of the face]
  FacePosition area{};  ///< weight times outward normal times area per reference area [m^2]
};

/// Points of a face with its nodes at the given positions, counter-clockwise seen from outside:
/// 3 or 4 corners, after which may follow the nodes in the middle of the edges 01 12 (23) and back;
/// or the 2 ends of a plane body's edge, the body on its left, for a metre of thickness.
///
/// The rules integrate shape functions times the area vector exactly, on any shape of the face:
/// one point of a triangle; 2 x 2 Gauss points of a bilinear quadrilateral (degree 2 in each
/// coordinate); Radon's 7 points of a quadratic triangle (degree 4 in total); 3 x 3 Gauss points of
/// a serendipity quadrilateral (degree 5 in each coordinate).
/// @throws InternalError  for another number of nodes
[[nodiscard]] std::vector<FacePoint> face_points(const std::vector<FacePosition>& nodes);

}  // namespace elastogen
