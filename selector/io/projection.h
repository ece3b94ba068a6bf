// Parallel projection of space onto the plane of a picture.
#pragma once

#include <Eigen/Core>

namespace elastogen::selector {

/// A view from far away. Picture coordinates: right and up, in the units of space.
struct Projection {
  Eigen::Vector3d right, up, to_eye;

  /// @param azimuth    the eye's turn from -y towards +x [rad]
  /// @param elevation  the eye's height over the plane z = 0 [rad]
  [[nodiscard]] static Projection from_angles(double azimuth, double elevation);

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector3d& point) const {
    return {right.dot(point), up.dot(point)};
  }
  /// Greater is nearer to the eye.
  [[nodiscard]] double nearness(const Eigen::Vector3d& point) const { return to_eye.dot(point); }
};

}  // namespace elastogen::selector
