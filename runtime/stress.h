// What the kernels' operation `stress` says of the points of a body.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace elastogen {

/// State at one quadrature point, as tensors in space: in plane strain H has a last row and column
/// of 0, and P its component P_33.
struct PointStress {
  Eigen::Matrix3d gradient;     ///< H = dU/dX
  Eigen::Matrix3d first_piola;  ///< P = dW/dH [Pa]
  double energy_density;        ///< W [J/m^3]
  double volume;                ///< of the rest shape that the point stands for [m^dim]
};

/// All points of all elements, in the mesh's order of elements: those of element e are
/// points[first[e]] ... points[first[e + 1] - 1], in the order of its quadrature.
struct StressField {
  std::vector<std::size_t> first;  ///< num_elements + 1
  std::vector<PointStress> points;
};

}  // namespace elastogen
