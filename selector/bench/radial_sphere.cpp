#include "selector/bench/radial_sphere.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "runtime/error.h"
#include "symgen/dag/evaluate.h"
#include "symgen/mechanics/density_graph.h"

namespace elastogen::selector {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double accuracy = 1e-10;

/// Energy density of H = diag(e, t, t), its gradient and its second derivatives by (e, t).
struct RadialDensity {
  Eigen::Vector2d stress;
  Eigen::Matrix2d tangent;
};

class RadialLaw {
 public:
  RadialLaw(const symgen::Law& law, const std::vector<double>& parameters)
      : graph_(build_density_graph(law, symgen::energy_density(law, 3, {}))) {
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      inputs_[graph_.parameters[p]] = parameters[p];
    }
    for (const int c : diagonal) {
      roots_.push_back(graph_.stress[static_cast<std::size_t>(c)]);
      for (const int d : diagonal) {
        roots_.push_back(graph_.tangent[static_cast<std::size_t>(c)][static_cast<std::size_t>(d)]);
      }
    }
  }

  [[nodiscard]] RadialDensity at(double along, double around) {
    for (std::size_t c = 0; c < 9; ++c) inputs_[graph_.gradient[c]] = 0;
    inputs_[graph_.gradient[0]] = along;
    inputs_[graph_.gradient[4]] = inputs_[graph_.gradient[8]] = around;
    const std::vector<double> v = symgen::evaluate<symgen::DoubleArithmetic>(
        graph_.dag, roots_, {}, [&](symgen::NodeId node) { return inputs_.at(node); });
    // Rows of `roots_`: stress, tangent by the three diagonal entries.
    RadialDensity density;
    density.stress = {v[0], v[4] + v[8]};
    const double mixed = v[2] + v[3];
    density.tangent << v[1], mixed, mixed, v[6] + v[7] + v[10] + v[11];
    return density;
  }

 private:
  static constexpr std::array<int, 3> diagonal = {0, 4, 8};
  symgen::DensityGraph graph_;
  std::vector<symgen::NodeId> roots_;
  std::unordered_map<symgen::NodeId, double> inputs_;
};

/// Chebyshev polynomials T_0 .. T_n and their derivatives at x in [-1, 1].
void chebyshev(double x, VectorXd& value, VectorXd& slope) {
  const Eigen::Index n = value.size() - 1;
  value[0] = 1;
  slope[0] = 0;
  if (n == 0) return;
  value[1] = x;
  slope[1] = 1;
  for (Eigen::Index k = 2; k <= n; ++k) {
    value[k] = 2 * x * value[k - 1] - value[k - 2];
    slope[k] = 2 * value[k - 1] + 2 * x * slope[k - 1] - slope[k - 2];
  }
}

struct GaussRule {
  std::vector<double> points, weights;  ///< on [-1, 1]
};

/// Points by Newton's method on the Legendre polynomial (Press et al., Numerical recipes, 3rd ed.,
/// section 4.6).
GaussRule gauss_legendre(int n) {
  GaussRule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double before = 1, value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.points.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

std::vector<double> solve(RadialLaw& law, const RadialProblem& problem, int degree) {
  const GaussRule rule = gauss_legendre(degree + 24);
  const double half = (problem.outer - problem.inner) / 2;
  const Eigen::Index size = degree + 1;
  VectorXd value(size), slope(size);
  VectorXd load(size);
  chebyshev(-1, value, slope);
  load = problem.pressure * problem.inner * problem.inner * value;

  VectorXd coefficients = VectorXd::Zero(size);
  // A load that grows keeps every start near its end.
  constexpr int load_steps = 16;
  for (int step = 1; step <= load_steps; ++step) {
    for (int iteration = 0;; ++iteration) {
      VectorXd residual = load * (static_cast<double>(step) / load_steps);
      MatrixXd tangent = MatrixXd::Zero(size, size);
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        const double radius = problem.inner + half * (1 + rule.points[g]);
        const double weight = rule.weights[g] * half * radius * radius;
        chebyshev(rule.points[g], value, slope);
        Eigen::Matrix<double, Eigen::Dynamic, 2> strain(size, 2);
        strain.col(0) = slope / half;
        strain.col(1) = value / radius;
        const Eigen::Vector2d stretch = strain.transpose() * coefficients;
        const RadialDensity density = law.at(stretch[0], stretch[1]);
        residual -= weight * strain * density.stress;
        tangent += weight * strain * density.tangent * strain.transpose();
      }
      const Eigen::LDLT<MatrixXd> factor(tangent);
      const VectorXd change = factor.solve(residual);
      if (!change.allFinite() || iteration == 50) {
        throw WorkError("no equilibrium of the thick sphere was found");
      }
      coefficients += change;
      if (change.norm() <= 1e-14 * coefficients.norm()) break;
      if (iteration > 8 && change.norm() <= 1e-12 * coefficients.norm()) break;
    }
  }
  return {coefficients.data(), coefficients.data() + size};
}

double displacement_of(const std::vector<double>& coefficients, const RadialProblem& problem,
                       double radius) {
  const double x = (2 * radius - problem.inner - problem.outer) / (problem.outer - problem.inner);
  VectorXd value(static_cast<Eigen::Index>(coefficients.size())), slope(value.size());
  chebyshev(x, value, slope);
  return value.dot(Eigen::Map<const VectorXd>(coefficients.data(), value.size()));
}

}  // namespace

RadialSphere::RadialSphere(const symgen::Law& law, const RadialProblem& problem)
    : problem_(problem) {
  RadialLaw radial(law, problem.parameters);
  coefficients_ = solve(radial, problem, 24);
  const std::vector<double> finer = solve(radial, problem, 32);
  double difference = 0, largest = 0;
  for (int k = 0; k <= 20; ++k) {
    const double radius = problem.inner + (problem.outer - problem.inner) * k / 20;
    const double u = displacement_of(finer, problem, radius);
    difference = std::max(difference, std::abs(displacement(radius) - u));
    largest = std::max(largest, std::abs(u));
  }
  if (!(difference <= accuracy * largest)) {
    throw WorkError(fmt::format("the thick sphere is solved to {:.1e} only, not to {:.0e}",
                                difference / largest, accuracy));
  }
}

double RadialSphere::displacement(double radius) const {
  return displacement_of(coefficients_, problem_, radius);
}

}  // namespace elastogen::selector
