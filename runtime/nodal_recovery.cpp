#include "runtime/nodal_recovery.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <cmath>
#include <limits>
#include <set>

#include "runtime/error.h"

namespace elastogen {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Matrix = Eigen::MatrixXd;

/// A rule's points in an element at rest.
struct RulePoints {
  Eigen::Map<const RowMatrix> shapes;  // [g][a]
  Matrix positions;                    // [i][g]
  Eigen::VectorXd volumes;             // [g]
};

/// @param nodes  positions at rest, [i][a]
RulePoints points_in(const ReferencePoints& rule, const Matrix& nodes) {
  const Eigen::Index n = nodes.cols(), dim = nodes.rows();
  RulePoints points{{rule.shapes, rule.num_points, n}, {}, Eigen::VectorXd(rule.num_points)};
  points.positions = nodes * points.shapes.transpose();
  for (Eigen::Index g = 0; g < rule.num_points; ++g) {
    const Eigen::Map<const RowMatrix> gradients(rule.gradients + g * n * dim, n, dim);
    points.volumes[g] = rule.weights[g] * (nodes * gradients).determinant();
  }
  return points;
}

/// The linear function fitted to values at points, as a matrix from those values to its values at
/// other places [place][g]. In coordinates from the points' centre the constant is the mean.
Matrix fit(const RulePoints& points, const Matrix& places) {
  constexpr double flat = 1e-12;  // squared extents that cannot be told from 0
  const double volume = points.volumes.sum();
  const Eigen::VectorXd centre = points.positions * points.volumes / volume;
  const Matrix from = points.positions.colwise() - centre;
  const Matrix to = places.colwise() - centre;
  const Matrix weighted = from * points.volumes.asDiagonal();
  Matrix result = Eigen::VectorXd::Ones(places.cols()) * points.volumes.transpose() / volume;
  const Eigen::SelfAdjointEigenSolver<Matrix> moments(weighted * from.transpose());
  const double extent = to.squaredNorm() * volume;
  if (!(moments.eigenvalues()[0] > flat * extent)) return result;
  result += to.transpose() * moments.eigenvectors() *
            moments.eigenvalues().cwiseInverse().asDiagonal() *
            (moments.eigenvectors().transpose() * weighted);
  return result;
}

}  // namespace

/// One element at rest.
struct NodalRecovery::Element {
  Element(const NodalRecovery& recovery, std::size_t e)
      : table(*recovery.tables_[e]),
        slots(recovery.element_slots(e)),
        first_point(recovery.first_point_[e]),
        nodes(recovery.dim_, table.num_nodes) {
    for (Eigen::Index a = 0; a < nodes.cols(); ++a) {
      const std::int32_t slot = slots[static_cast<std::size_t>(a)];
      const auto node = static_cast<std::size_t>(recovery.nodes_[static_cast<std::size_t>(slot)]);
      nodes.col(a) = Eigen::Map<const Eigen::VectorXd>(
          recovery.positions_.data() + node * static_cast<std::size_t>(recovery.dim_),
          recovery.dim_);
    }
  }

  [[nodiscard]] Eigen::Map<const RowMatrix> values(std::span<const double> all, int width) const {
    return {all.data() + first_point * static_cast<std::size_t>(width), table.num_points, width};
  }
  /// sum[slot] += rows
  void add(const Matrix& rows, std::vector<double>& sum) const {
    const auto width = static_cast<std::size_t>(rows.cols());
    for (std::size_t a = 0; a < slots.size(); ++a) {
      Eigen::Map<Eigen::RowVectorXd>(sum.data() + static_cast<std::size_t>(slots[a]) * width,
                                     rows.cols()) += rows.row(static_cast<Eigen::Index>(a));
    }
  }

  const KernelTable<double>& table;
  std::span<const std::int32_t> slots;
  std::size_t first_point;
  Matrix nodes;  // positions [i][a]
};

NodalRecovery::NodalRecovery(const Mesh& mesh, std::span<const ModelPart> parts,
                             std::span<const int> zones)
    : dim_(mesh.dim), num_nodes_(mesh.num_nodes()), positions_(mesh.positions) {
  std::vector<std::size_t> first_element = {0};
  for (const ElementBlock& block : mesh.blocks) {
    first_element.push_back(first_element.back() + block.num_elements());
  }
  std::vector<int> zone_of(mesh.num_elements(), 0);
  tables_.resize(mesh.num_elements());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const KernelTable<double>& table = *parts[p].kernels;
    if (table.points.num_points != table.num_points || table.rich_points.num_points == 0) {
      throw InternalError(
          fmt::format("kernels of {}: they do not tell where their points are", table.association));
    }
    for (const std::int32_t k : parts[p].elements) {
      const std::size_t e = first_element[parts[p].block] + static_cast<std::size_t>(k);
      tables_[e] = &table;
      zone_of[e] = zones[p];
    }
  }

  int num_zones = 0;
  for (const int zone : zones) num_zones = std::max(num_zones, zone + 1);
  constexpr std::int32_t none = -1;
  std::vector<std::int32_t> slot_of(num_nodes_ * static_cast<std::size_t>(num_zones), none);
  std::size_t e = 0;
  first_slot_ = {0};
  first_point_ = {0};
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t k = 0; k < block.num_elements(); ++k, ++e) {
      for (const std::int32_t node : block.element_nodes(k)) {
        std::int32_t& slot = slot_of[static_cast<std::size_t>(zone_of[e]) * num_nodes_ +
                                     static_cast<std::size_t>(node)];
        if (slot == none) {
          slot = static_cast<std::int32_t>(nodes_.size());
          nodes_.push_back(node);
          zones_.push_back(zone_of[e]);
        }
        slots_.push_back(slot);
      }
      first_slot_.push_back(slots_.size());
      first_point_.push_back(first_point_.back() +
                             static_cast<std::size_t>(tables_[e]->num_points));
    }
  }
  volumes_.assign(nodes_.size(), 0.0);
  for (e = 0; e < tables_.size(); ++e) {
    const Element element(*this, e);
    const double volume = points_in(element.table.points, element.nodes).volumes.sum();
    for (const std::int32_t slot : element.slots) {
      volumes_[static_cast<std::size_t>(slot)] += volume;
    }
  }
}

std::span<const std::int32_t> NodalRecovery::element_slots(std::size_t element) const {
  return std::span(slots_).subspan(first_slot_[element],
                                   first_slot_[element + 1] - first_slot_[element]);
}

std::vector<double> NodalRecovery::average(std::span<const double> values, int width) const {
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> sum(num_slots() * w, 0.0);
  for (std::size_t e = 0; e < tables_.size(); ++e) {
    const Element element(*this, e);
    const RulePoints points = points_in(element.table.points, element.nodes);
    element.add(points.volumes.sum() * fit(points, element.nodes) * element.values(values, width),
                sum);
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= volumes_[k / w];
  return sum;
}

void NodalRecovery::make_mass_matrix() {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < tables_.size(); ++e) {
    const Element element(*this, e);
    const RulePoints rich = points_in(element.table.rich_points, element.nodes);
    const Matrix mass = rich.shapes.transpose() * rich.volumes.asDiagonal() * rich.shapes;
    for (Eigen::Index a = 0; a < mass.rows(); ++a) {
      for (Eigen::Index b = 0; b < mass.cols(); ++b) {
        entries.emplace_back(element.slots[static_cast<std::size_t>(a)],
                             element.slots[static_cast<std::size_t>(b)], mass(a, b));
      }
    }
  }
  const auto size = static_cast<Eigen::Index>(num_slots());
  mass_.resize(size, size);
  mass_.setFromTriplets(entries.begin(), entries.end());
}

std::vector<double> NodalRecovery::project(std::span<const double> values, int width) {
  constexpr double tolerance = 1e-12;
  constexpr int most_iterations = 1000;  // some 40 are usual
  if (mass_.rows() == 0) make_mass_matrix();
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> result(num_slots() * w, 0.0);
  for (std::size_t e = 0; e < tables_.size(); ++e) {
    const Element element(*this, e);
    const RulePoints points = points_in(element.table.points, element.nodes);
    const RulePoints rich = points_in(element.table.rich_points, element.nodes);
    element.add(rich.shapes.transpose() * rich.volumes.asDiagonal() * fit(points, rich.positions) *
                    element.values(values, width),
                result);
  }
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(mass_);
  solver.setTolerance(tolerance);
  solver.setMaxIterations(most_iterations);
  Eigen::Map<RowMatrix> columns(result.data(), static_cast<Eigen::Index>(num_slots()), width);
  for (Eigen::Index k = 0; k < width; ++k) {
    // Zones have no entries of the matrix in common: what is not finite in one is left out.
    Eigen::VectorXd right = columns.col(k);
    std::set<int> lost;
    for (Eigen::Index slot = 0; slot < right.size(); ++slot) {
      if (!std::isfinite(right[slot])) lost.insert(zones_[static_cast<std::size_t>(slot)]);
    }
    const auto is_lost = [&](Eigen::Index slot) {
      return !lost.empty() && lost.contains(zones_[static_cast<std::size_t>(slot)]);
    };
    for (Eigen::Index slot = 0; slot < right.size(); ++slot) {
      if (is_lost(slot)) right[slot] = 0;
    }
    columns.col(k) = solver.solve(right);
    if (solver.info() != Eigen::Success) {
      throw WorkError(
          fmt::format("projection onto the nodes: no solution after {} iterations of conjugate "
                      "gradient (relative residual {:.1e})",
                      solver.iterations(), solver.error()));
    }
    for (Eigen::Index slot = 0; slot < right.size(); ++slot) {
      if (is_lost(slot)) columns(slot, k) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return result;
}

std::vector<double> NodalRecovery::joined(std::span<const double> slot_values, int width) const {
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> sum(num_nodes_ * w, 0.0), volume(num_nodes_, 0.0);
  for (std::size_t slot = 0; slot < num_slots(); ++slot) {
    const auto node = static_cast<std::size_t>(nodes_[slot]);
    volume[node] += volumes_[slot];
    for (std::size_t k = 0; k < w; ++k) {
      sum[node * w + k] += volumes_[slot] * slot_values[slot * w + k];
    }
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= volume[k / w];
  return sum;
}

std::vector<double> NodalRecovery::point_positions() const {
  std::vector<double> result = at_points(positions_, dim_);
  if (dim_ == 3) return result;
  std::vector<double> in_space;
  for (std::size_t k = 0; k < result.size(); k += 2) {
    in_space.insert(in_space.end(), {result[k], result[k + 1], 0.0});
  }
  return in_space;
}

std::vector<double> NodalRecovery::at_points(std::span<const double> node_values, int width) const {
  std::vector<double> result(first_point_.back() * static_cast<std::size_t>(width));
  Matrix nodal;
  for (std::size_t e = 0; e < tables_.size(); ++e) {
    const Element element(*this, e);
    const Eigen::Index n = element.table.num_nodes;
    nodal.resize(n, width);
    for (Eigen::Index a = 0; a < n; ++a) {
      const std::int32_t slot = element.slots[static_cast<std::size_t>(a)];
      nodal.row(a) = Eigen::Map<const Eigen::RowVectorXd>(
          node_values.data() + nodes_[static_cast<std::size_t>(slot)] * width, width);
    }
    const Eigen::Map<const RowMatrix> shapes(element.table.points.shapes, element.table.num_points,
                                             n);
    Eigen::Map<RowMatrix>(result.data() + element.first_point * static_cast<std::size_t>(width),
                          element.table.num_points, width) = shapes * nodal;
  }
  return result;
}

}  // namespace elastogen
