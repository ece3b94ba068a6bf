// Vectors of nodes as vectors of space.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace elastogen::selector {

/// A node's part of a nodal vector, filled up with 0 in the plane.
[[nodiscard]] inline Eigen::Vector3d at_node(std::span<const double> values, std::size_t node,
                                             std::size_t dim) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < dim; ++c) {
    result[static_cast<Eigen::Index>(c)] = values[dim * node + c];
  }
  return result;
}

}  // namespace elastogen::selector
