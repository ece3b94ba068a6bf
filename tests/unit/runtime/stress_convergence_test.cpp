// Stress of solved bodies against exact solutions of linear elasticity: how its error falls with
// the cells' size, at the elements, and at the nodes by either way. The loads are so small that the
// nonlinear law does not tell.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "runtime/constraints.h"
#include "runtime/model.h"
#include "runtime/newton.h"
#include "runtime/nodal_recovery.h"
#include "runtime/stress_measures.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

constexpr double young = 1e5, poisson = 0.3, shear = young / (2 * (1 + poisson));

/// A body whose mesh is that of a box, moved, with an exact solution.
struct ExactBody {
  std::function<Vector3(const Vector3&)> shape;         // of the box [0, 1]^3
  std::function<Vector3(const Vector3&)> displacement;  // of the place at rest
  std::function<Matrix3(const Vector3&)> stress;
  std::function<bool(const Vector3&, int component)> held;  // of the place in the box
};

struct Errors {
  std::map<std::string, double> of;  // relative, root mean square; by place
  Matrix3 last_corner;               // recovered stress at the box's corner (0, 1, 0)
};

/// Root of the mean square difference, relative to that of the exact stress.
double relative_error(const std::vector<double>& found, const std::vector<double>& positions,
                      const ExactBody& body) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < positions.size() / 3; ++k) {
    const Matrix3 exact = body.stress(Eigen::Map<const Vector3>(&positions[3 * k]));
    SymmetricTensor components;
    std::copy_n(&found[6 * k], 6, components.begin());
    difference += (tensor_of(components) - exact).squaredNorm();
    size += exact.squaredNorm();
  }
  return std::sqrt(difference / size);
}

Errors solve(const ExactBody& body, std::array<int, 3> cells) {
  const KernelTable<double> table = ReferenceKernels<Hexa8, 4, false>::table();
  Mesh mesh = bar_mesh("hexa8", cells, {1, 1, 1});
  Constraints constraints(mesh.num_nodes(), 3);
  std::size_t corner = 0;
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    Eigen::Map<Vector3> at(&mesh.positions[3 * node]);
    const Vector3 in_box = at;
    if ((in_box - Vector3(0, 1, 0)).norm() < 1e-9) corner = node;
    at = body.shape(in_box);
    const Vector3 u = body.displacement(at);
    for (int i = 0; i < 3; ++i) {
      if (body.held(in_box, i)) constraints.prescribe(node, i, u[i]);
    }
  }
  const std::vector<ModelPart> parts = one_part(mesh, table);
  Model model(mesh, parts, {.threads = 1});
  Vector u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  NewtonOptions options;
  options.linear_solver.kind = LinearSolverKind::cholesky;
  options.tolerance = 1e-7;
  const NewtonResult result = solve_static(model, constraints, Vector::Zero(u.size()), options, u);
  EXPECT_EQ(result.status, NewtonStatus::converged) << result.reason;

  StressField field;
  model.stress(u, field);
  std::vector<double> points, elements, centres;
  NodalRecovery recovery(mesh, parts, std::vector<int>{0});
  const std::vector<double> at = recovery.point_positions();
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    Matrix3 mean = Matrix3::Zero();
    Vector3 centre = Vector3::Zero();
    double volume = 0;
    for (std::size_t p = field.first[e]; p < field.first[e + 1]; ++p) {
      const Matrix3 stress = cauchy_stress(field.points[p], Kinematics::finite);
      const SymmetricTensor components = symmetric_components(stress);
      points.insert(points.end(), components.begin(), components.end());
      volume += field.points[p].volume;
      mean += field.points[p].volume * stress;
      centre += field.points[p].volume * Eigen::Map<const Vector3>(&at[3 * p]);
    }
    const SymmetricTensor components = symmetric_components(mean / volume);
    elements.insert(elements.end(), components.begin(), components.end());
    centre /= volume;
    centres.insert(centres.end(), centre.begin(), centre.end());
  }
  const std::vector<double> average = recovery.joined(recovery.average(points, 6), 6);
  const std::vector<double> projection = recovery.joined(recovery.project(points, 6), 6);
  SymmetricTensor components;
  std::copy_n(&average[6 * corner], 6, components.begin());
  return {{{"elements", relative_error(elements, centres, body)},
           {"average", relative_error(average, mesh.positions, body)},
           {"projection", relative_error(projection, mesh.positions, body)}},
          tensor_of(components)};
}

/// Cells were halved. Means of elements come with the second order, as stress is best in the
/// middle of linear elements (Barlow, Int. J. Numer. Methods Eng. 10 (1976) 243-251); nodes with
/// the first, the order of stress elsewhere in these: on surfaces nothing makes up for it. On
/// meshes this coarse the factor of 4 is not reached: above 2.83 it is nearer to that than to 2.
void expect_order(const Errors& coarse, const Errors& fine) {
  for (const auto& [place, error] : fine.of) {
    testing::Test::RecordProperty(place, std::to_string(error));
    const bool of_elements = place == "elements";
    EXPECT_GT(coarse.of.at(place) / error, of_elements ? 2.83 : 2) << place << ": " << error;
    EXPECT_LT(error, of_elements ? 0.005 : 0.2) << place;
  }
  EXPECT_LT(fine.of.at("projection"), fine.of.at("average"));
}

// A thick sphere under pressure from inside: u = A r + B / r^2 (Lame; Timoshenko & Goodier, Theory
// of Elasticity, 3rd ed., section 142). A piece of it that moves as the whole does on its sides.
TEST(StressConvergence, OfLamesSphere) {
  static constexpr double a = 1, b = 2, pressure = 1e-3;
  static constexpr double p = pressure * a * a * a / (b * b * b - a * a * a);
  ExactBody body;
  body.shape = [](const Vector3& box) {
    return Vector3((a + (b - a) * box[2]) * Vector3(box[0] - 0.5, box[1] - 0.5, 1).normalized());
  };
  body.displacement = [](const Vector3& x) {
    const double r = x.norm();
    return Vector3(p / young * (1 - 2 * poisson + (1 + poisson) / 2 * std::pow(b / r, 3)) * x);
  };
  body.stress = [](const Vector3& x) {
    const double cube = std::pow(b / x.norm(), 3);
    const Vector3 n = x.normalized();
    return Matrix3(p * ((1 + cube / 2) * Matrix3::Identity() - 1.5 * cube * n * n.transpose()));
  };
  body.held = [](const Vector3& box, int) {
    return box.minCoeff() < 1e-9 || box.maxCoeff() > 1 - 1e-9;
  };
  expect_order(solve(body, {4, 4, 4}), solve(body, {8, 8, 8}));
}

// Kirsch's plate with a hole of radius 1, pulled along x, in plane strain: the quarter up to the
// radius 4, whose outside moves as the infinite plate does there (Kirsch, VDI-Z. 42 (1898) 797-807;
// displacements: Szabo & Babuska, Finite Element Analysis, 1991, section 4.2). On the hole the
// stress is three times that far away.
TEST(StressConvergence, OfKirschsPlate) {
  static constexpr double far = 1e-3, kappa = 3 - 4 * poisson;
  ExactBody body;
  body.shape = [](const Vector3& box) {
    const double r = std::pow(4.0, box[0]), angle = box[1] * std::numbers::pi / 2;
    return Vector3(r * std::cos(angle), r * std::sin(angle), 0.2 * box[2]);
  };
  body.displacement = [](const Vector3& x) {
    const double r = std::hypot(x[0], x[1]), t = std::atan2(x[1], x[0]);
    const double ux = r * (kappa + 1) * std::cos(t) +
                      2 / r * ((1 + kappa) * std::cos(t) + std::cos(3 * t)) -
                      2 / (r * r * r) * std::cos(3 * t);
    const double uy = r * (kappa - 3) * std::sin(t) +
                      2 / r * ((1 - kappa) * std::sin(t) + std::sin(3 * t)) -
                      2 / (r * r * r) * std::sin(3 * t);
    return Vector3(far / (8 * shear) * Vector3(ux, uy, 0));
  };
  body.stress = [](const Vector3& x) {
    const double r = std::hypot(x[0], x[1]), t = std::atan2(x[1], x[0]);
    const double s = 1 / (r * r), q = 1.5 * s * s;
    Matrix3 stress = Matrix3::Zero();
    stress(0, 0) = 1 - s * (1.5 * std::cos(2 * t) + std::cos(4 * t)) + q * std::cos(4 * t);
    stress(1, 1) = -s * (0.5 * std::cos(2 * t) - std::cos(4 * t)) - q * std::cos(4 * t);
    stress(0, 1) = -s * (0.5 * std::sin(2 * t) + std::sin(4 * t)) + q * std::sin(4 * t);
    stress(1, 0) = stress(0, 1);
    stress(2, 2) = poisson * (stress(0, 0) + stress(1, 1));
    return Matrix3(far * stress);
  };
  body.held = [](const Vector3& box, int component) {
    if (component == 2 || box[0] > 1 - 1e-9) return true;
    return component == 1 ? box[1] < 1e-9 : box[1] > 1 - 1e-9;
  };
  const Errors coarse = solve(body, {12, 12, 1}), fine = solve(body, {24, 24, 1});
  expect_order(coarse, fine);
  const double concentration = fine.last_corner(0, 0) / far;
  RecordProperty("concentration", std::to_string(concentration));
  EXPECT_NEAR(concentration, 3, 0.1);
  EXPECT_LT(std::abs(concentration - 3), std::abs(coarse.last_corner(0, 0) / far - 3));
}

}  // namespace
}  // namespace elastogen::test
