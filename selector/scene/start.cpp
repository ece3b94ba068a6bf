#include "selector/scene/start.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <random>

#include "selector/scene/node_vector.h"

namespace elastogen::selector {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
};

std::vector<Range> box_of(const Mesh& mesh) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::vector<Range> box(dim);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    box[k % dim].low = std::min(box[k % dim].low, mesh.positions[k]);
    box[k % dim].high = std::max(box[k % dim].high, mesh.positions[k]);
  }
  return box;
}

}  // namespace

const std::vector<std::string>& start_names() {
  static const std::vector<std::string> names = {"rest", "inverted", "flattened", "scrambled"};
  return names;
}

Vector start_displacement(const Mesh& mesh, Start start) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const std::vector<Range> box = box_of(mesh);
  std::mt19937 generator(1);
  Vector u = Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const double x = mesh.positions[k];
    const Range& range = box[k % dim];
    const double from_centre = x - (range.low + range.high) / 2;
    double& value = u[static_cast<Eigen::Index>(k)];
    if (start == Start::inverted && k % dim == 0) value = -2 * from_centre;
    if (start == Start::flattened && k % dim == 0) value = -from_centre;
    if (start == Start::scrambled) {
      value = std::uniform_real_distribution<double>(range.low, range.high)(generator) - x;
    }
  }
  return u;
}

Vector spin_velocity(const Mesh& mesh, std::span<const double> mass,
                     const std::array<double, 3>& spin) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const Eigen::Vector3d angular_velocity(spin[0], spin[1], spin[2]);
  if (angular_velocity.isZero(0))
    return Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double total = 0;
  for (std::size_t node = 0; node < mass.size(); ++node) {
    centre += mass[node] * at_node(mesh.positions, node, dim);
    total += mass[node];
  }
  centre /= total;
  Vector velocity(static_cast<Eigen::Index>(mesh.positions.size()));
  for (std::size_t node = 0; node < mass.size(); ++node) {
    const Eigen::Vector3d v = angular_velocity.cross(at_node(mesh.positions, node, dim) - centre);
    velocity.segment(static_cast<Eigen::Index>(dim * node), mesh.dim) = v.head(mesh.dim);
  }
  return velocity;
}

}  // namespace elastogen::selector
