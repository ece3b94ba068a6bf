#include "selector/scene/rigid_motions.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace elastogen::selector {
namespace {

using RigidMotion = Eigen::Matrix<double, 6, 1>;  // translation, rotation

/// Connected parts by union-find; the root of each node.
std::vector<std::size_t> part_roots(const Mesh& mesh) {
  std::vector<std::size_t> parent(mesh.num_nodes());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const auto nodes = block.element_nodes(e);
      const std::size_t first = root(static_cast<std::size_t>(nodes[0]));
      for (const std::int32_t node : nodes) parent[root(static_cast<std::size_t>(node))] = first;
    }
  }
  for (std::size_t node = 0; node < parent.size(); ++node) parent[node] = root(node);
  return parent;
}

std::string describe(const RigidMotion& motion) {
  constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
  const bool rotates = motion.tail<3>().norm() > 1e-6 * motion.norm();
  const Eigen::Vector3d direction = rotates ? motion.tail<3>() : motion.head<3>();
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  const bool along_axis = std::abs(direction[largest]) > (1 - 1e-9) * direction.norm();
  const std::string along = along_axis ? axes[static_cast<std::size_t>(largest)]
                                       : fmt::format("({:.3g}, {:.3g}, {:.3g})", direction[0],
                                                     direction[1], direction[2]);
  return fmt::format("{} along {}", rotates ? "a rotation about an axis" : "a translation", along);
}

/// In space; z = 0 in the plane.
Eigen::Vector3d position_of(const Mesh& mesh, std::size_t node) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t c = 0; c < dim; ++c) {
    position[static_cast<Eigen::Index>(c)] = mesh.positions[dim * node + c];
  }
  return position;
}

/// Sum over a part's constrained degrees of freedom of m m^T, m its share in the six motions.
/// Lengths are taken from the part's middle and in units of its size, so that translations and
/// rotations compare. What would leave the plane of a plane mesh counts as held.
Eigen::Matrix<double, 6, 6> constrained_gram(const Mesh& mesh, const Constraints& constraints,
                                             const std::vector<std::size_t>& nodes) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  Eigen::AlignedBox3d box;
  for (const std::size_t node : nodes) {
    box.extend(position_of(mesh, node));
  }
  const double size = box.diagonal().norm();
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  if (mesh.dim == 2) gram.diagonal() << 0, 0, 1, 1, 1, 0;
  for (const std::size_t node : nodes) {
    const Eigen::Vector3d arm = (position_of(mesh, node) - box.center()) / size;
    for (int c = 0; c < mesh.dim; ++c) {
      if (!constraints.is_constrained(dim * node + static_cast<std::size_t>(c))) continue;
      RigidMotion share;
      share.head<3>() = Eigen::Vector3d::Unit(c);
      share.tail<3>() = arm.cross(Eigen::Vector3d::Unit(c));
      gram += share * share.transpose();
    }
  }
  return gram;
}

}  // namespace

FreeRigidMotion find_free_rigid_motion(const Mesh& mesh, const Constraints& constraints) {
  const std::vector<std::size_t> roots = part_roots(mesh);
  std::vector<std::vector<std::size_t>> parts(roots.size());
  for (std::size_t node = 0; node < roots.size(); ++node) parts[roots[node]].push_back(node);
  std::erase_if(parts, [](const auto& nodes) { return nodes.empty(); });

  FreeRigidMotion result;
  result.num_parts = parts.size();
  for (const std::vector<std::size_t>& nodes : parts) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
        constrained_gram(mesh, constraints, nodes));
    // Eigenvalues are squares, ascending: 1e-12 means held by a millionth of the part's size.
    const double limit = 1e-12 * std::max(1.0, solver.eigenvalues()[5]);
    result.count = static_cast<int>((solver.eigenvalues().array() <= limit).count());
    if (result.count > 0) {
      result.example = describe(solver.eigenvectors().col(0));
      result.node = nodes.front();
      return result;
    }
  }
  return result;
}

}  // namespace elastogen::selector
