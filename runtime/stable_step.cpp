#include "runtime/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/error.h"

namespace elastogen {
namespace {

constexpr int max_iterations = 200;
constexpr double converged_change = 1e-4;
constexpr double relative_difference = 1e-6;  // of the body's size, greatest displacement

}  // namespace

double critical_step(Model& model, const Constraints& constraints, const ConstVectorRef& u) {
  const auto n = static_cast<Eigen::Index>(model.num_dofs());
  const auto dim = static_cast<Eigen::Index>(model.dim());
  double volume = 0;
  for (const double v : model.element_volumes()) volume += v;
  const double length =
      std::pow(volume / static_cast<double>(model.num_elements()), 1.0 / static_cast<double>(dim));

  // x is in coordinates scaled by the root of the mass: M^-1/2 K M^-1/2 is symmetric.
  Vector scale = Vector::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double mass = model.lumped_mass()[static_cast<std::size_t>(k / dim)];
    if (mass > 0) scale[k] = 1 / std::sqrt(mass);
  }
  constraints.project(scale);
  std::mt19937 generator(1);
  Vector x(n);
  for (double& value : x) value = static_cast<double>(generator()) / 4294967296.0 - 0.5;

  Vector up(n), down(n);
  double eigenvalue = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const double size = x.norm();
    if (!(size > 0)) break;
    x /= size;
    const Vector direction = scale.cwiseProduct(x);
    const double largest = direction.cwiseAbs().maxCoeff();
    if (!(largest > 0)) break;
    const double epsilon = relative_difference * length / largest;
    up.setZero();
    model.forces(u + epsilon * direction, up);
    const bool up_good = model.status().ok();
    down.setZero();
    model.forces(u - epsilon * direction, down);
    if (!up_good || !model.status().ok()) {
      throw InputError("critical time step: " + model.describe(model.status()));
    }
    const Vector image = scale.cwiseProduct(down - up) / (2 * epsilon);
    const double next = x.dot(image) / x.squaredNorm();
    x = image;
    const bool done = std::abs(next - eigenvalue) <= converged_change * std::abs(next);
    eigenvalue = std::max(eigenvalue, next);
    if (done && iteration > 10) break;
  }
  return eigenvalue > 0 ? 2 / std::sqrt(eigenvalue) : std::numeric_limits<double>::infinity();
}

}  // namespace elastogen
