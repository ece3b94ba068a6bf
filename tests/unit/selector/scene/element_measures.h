// Volumes and Jacobians of elements, by ways that the mesh makers do not use.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "selector/io/element_topology.h"
#include "symgen/element/element.h"

namespace elastogen::selector {

inline Eigen::Vector3d node_position(std::span<const double> positions, std::int32_t node) {
  return Eigen::Map<const Eigen::Vector3d>(&positions[3 * static_cast<std::size_t>(node)]);
}

/// Volume by the divergence theorem over the faces, counter-clockwise seen from outside: negative
/// for an element that is inside out, wrong if a face is turned. Exact for plane faces.
inline double volume_by_faces(std::span<const double> positions,
                              std::span<const std::int32_t> nodes, const std::string& element) {
  double volume = 0;
  for (const std::vector<int>& nodes_of_face : element_topology(element).faces) {
    const std::vector<int> face = around_face(nodes_of_face);
    const auto corner = [&](std::size_t i) {
      return node_position(positions, nodes[static_cast<std::size_t>(face[i])]);
    };
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      volume += corner(0).dot(corner(i).cross(corner(i + 1))) / 6;
    }
  }
  return volume;
}

/// Derivatives of an element's shape functions, [node](coordinate), at points near each node.
class ShapeGradients {
 public:
  explicit ShapeGradients(const std::string& name) {
    const symgen::Element& element = symgen::find_element(name);
    std::vector<double> centre(3, 0.0);
    for (const auto& node : element.nodes) {
      for (std::size_t c = 0; c < 3; ++c) {
        centre[c] += GiNaC::ex_to<GiNaC::numeric>(node[c]).to_double() / element.num_nodes();
      }
    }
    for (const auto& node : element.nodes) {
      // A tenth of the way to the centre: the pyramid's functions have no derivatives at its apex.
      GiNaC::exmap at;
      for (std::size_t c = 0; c < 3; ++c) {
        at[element.coordinates[c]] =
            0.9 * GiNaC::ex_to<GiNaC::numeric>(node[c]).to_double() + 0.1 * centre[c];
      }
      Eigen::MatrixXd gradients(element.num_nodes(), 3);
      for (int a = 0; a < element.num_nodes(); ++a) {
        for (int c = 0; c < 3; ++c) {
          const GiNaC::ex derivative = element.shape_functions[static_cast<std::size_t>(a)].diff(
              element.coordinates[static_cast<std::size_t>(c)]);
          gradients(a, c) = GiNaC::ex_to<GiNaC::numeric>(derivative.subs(at).evalf()).to_double();
        }
      }
      at_points_.push_back(gradients);
    }
  }

  /// The least Jacobian determinant over the points.
  [[nodiscard]] double least_jacobian(std::span<const double> positions,
                                      std::span<const std::int32_t> nodes) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::MatrixXd& gradients : at_points_) {
      Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
      for (Eigen::Index a = 0; a < gradients.rows(); ++a) {
        jacobian += node_position(positions, nodes[static_cast<std::size_t>(a)]) * gradients.row(a);
      }
      least = std::min(least, jacobian.determinant());
    }
    return least;
  }

 private:
  std::vector<Eigen::MatrixXd> at_points_;
};

}  // namespace elastogen::selector
