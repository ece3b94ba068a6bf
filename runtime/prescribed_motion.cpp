#include "runtime/prescribed_motion.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/error.h"

namespace elastogen {
namespace {

void check_constrained(const Constraints& constraints, std::size_t dof) {
  if (dof >= constraints.num_dofs() || !constraints.is_constrained(dof)) {
    throw InternalError(
        fmt::format("prescribed motion of degree of freedom {}: it is not constrained", dof));
  }
}

}  // namespace

History History::table(std::vector<std::pair<double, double>> points) {
  if (points.empty()) throw InputError("a history needs one point [time, value] or more");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [time, value] = points[i];
    if (!std::isfinite(time) || !std::isfinite(value)) {
      throw InputError(
          fmt::format("point {} of a history is [{}, {}]; must be finite", i + 1, time, value));
    }
    if (i > 0 && time <= points[i - 1].first) {
      throw InputError(fmt::format("times of a history must ascend; {} comes after {}", time,
                                   points[i - 1].first));
    }
  }
  History history;
  history.points_ = std::move(points);
  return history;
}

History History::sine(double frequency) {
  if (!(frequency > 0) || !std::isfinite(frequency)) {
    throw InputError(
        fmt::format("frequency {} Hz of a history; must be greater than 0", frequency));
  }
  History history;
  history.frequency_ = frequency;
  return history;
}

double History::operator()(double time) const {
  if (frequency_ > 0) return std::sin(2 * std::numbers::pi * frequency_ * time);
  if (points_.empty()) return time;
  const auto after = std::upper_bound(points_.begin(), points_.end(), time,
                                      [](double t, const auto& point) { return t < point.first; });
  if (after == points_.begin()) return points_.front().second;
  if (after == points_.end()) return points_.back().second;
  const auto& [t0, value0] = *(after - 1);
  const auto& [t1, value1] = *after;
  return value0 + (value1 - value0) * ((time - t0) / (t1 - t0));
}

PrescribedMotion::PrescribedMotion(const Constraints& constraints) : constraints_(constraints) {}

PrescribedMotion PrescribedMotion::growing(const Constraints& constraints) {
  PrescribedMotion motion(constraints);
  for (std::size_t dof = 0; dof < constraints.num_dofs(); ++dof) {
    if (constraints.value(dof) == 0) continue;
    motion.translations_.push_back({dof, constraints.value(dof), History()});
  }
  return motion;
}

void PrescribedMotion::translate(std::size_t node, int component, double displacement,
                                 const History& history) {
  const std::size_t dof =
      node * static_cast<std::size_t>(constraints_.dim()) + static_cast<std::size_t>(component);
  check_constrained(constraints_, dof);
  translations_.push_back({dof, displacement, history});
}

void PrescribedMotion::rotate(const Mesh& mesh, std::span<const std::int32_t> nodes,
                              const Rotation& rotation, const History& history) {
  const Eigen::Vector3d axis(rotation.axis[0], rotation.axis[1], rotation.axis[2]);
  const Eigen::Vector3d point(rotation.point[0], rotation.point[1], rotation.point[2]);
  if (!axis.allFinite() || !point.allFinite() || !std::isfinite(rotation.angle) ||
      !(axis.norm() > 0)) {
    throw InputError(fmt::format(
        "rotation by {} rad about [{}, {}, {}] through [{}, {}, {}]: all must be finite and the "
        "axis not 0",
        rotation.angle, axis[0], axis[1], axis[2], point[0], point[1], point[2]));
  }
  const auto dim = static_cast<std::size_t>(mesh.dim);
  if (dim == 2 && (axis[0] != 0 || axis[1] != 0)) {
    throw InputError(fmt::format("rotation about [{}, {}, {}]: in the plane the axis is along z",
                                 axis[0], axis[1], axis[2]));
  }
  const Eigen::Vector3d unit = axis.normalized();
  Turn turn{{}, {}, {unit[0], unit[1], unit[2]}, rotation.angle, history};
  for (const std::int32_t number : nodes) {
    const auto node = static_cast<std::size_t>(number);
    for (std::size_t i = 0; i < dim; ++i) check_constrained(constraints_, dim * node + i);
    for (std::size_t i = 0; i < 3; ++i) {
      turn.arms.push_back(i < dim ? mesh.positions[dim * node + i] - rotation.point[i] : 0.0);
    }
    turn.nodes.push_back(node);
  }
  rotations_.push_back(std::move(turn));
}

std::vector<std::int32_t> PrescribedMotion::held_nodes() const {
  const auto dim = static_cast<std::size_t>(constraints_.dim());
  std::vector<bool> is_held(constraints_.num_dofs() / dim, true);
  for (std::size_t dof = 0; dof < constraints_.num_dofs(); ++dof) {
    const bool is_zero = constraints_.is_constrained(dof) && constraints_.value(dof) == 0;
    if (!is_zero) is_held[dof / dim] = false;
  }
  for (const Translation& translation : translations_) is_held[translation.dof / dim] = false;
  for (const Turn& turn : rotations_) {
    for (const std::size_t node : turn.nodes) is_held[node] = false;
  }
  std::vector<std::int32_t> nodes;
  for (std::size_t node = 0; node < is_held.size(); ++node) {
    if (is_held[node]) nodes.push_back(static_cast<std::int32_t>(node));
  }
  return nodes;
}

void PrescribedMotion::impose(double time, VectorRef u) const {
  constraints_.impose(u);
  for (const Translation& translation : translations_) {
    u[static_cast<Eigen::Index>(translation.dof)] =
        translation.history(time) * translation.displacement;
  }
  const int dim = constraints_.dim();
  for (const Turn& turn : rotations_) {
    const Eigen::AngleAxisd rotation(turn.history(time) * turn.angle,
                                     Eigen::Map<const Eigen::Vector3d>(turn.axis.data()));
    const Eigen::Matrix3d change = rotation.toRotationMatrix() - Eigen::Matrix3d::Identity();
    for (std::size_t k = 0; k < turn.nodes.size(); ++k) {
      const Eigen::Vector3d moved = change * Eigen::Map<const Eigen::Vector3d>(&turn.arms[3 * k]);
      u.segment(static_cast<Eigen::Index>(turn.nodes[k]) * dim, dim) = moved.head(dim);
    }
  }
}

}  // namespace elastogen
