#include "runtime/loads.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/error.h"

namespace elastogen {
namespace {

void check_finite(std::span<const double> values, const char* what) {
  for (const double value : values) {
    if (!std::isfinite(value)) {
      throw InputError(fmt::format("{}: component {}; must be finite", what, value));
    }
  }
}

}  // namespace

void add_gravity(const Model& model, std::span<const double> acceleration, VectorRef f) {
  const std::size_t dim = static_cast<std::size_t>(model.dim());
  if (acceleration.size() != dim) {
    throw InputError(fmt::format("gravity: {} components; must be {}", acceleration.size(), dim));
  }
  check_finite(acceleration, "gravity");
  const std::span<const double> mass = model.nodal_mass();
  for (std::size_t node = 0; node < mass.size(); ++node) {
    for (std::size_t i = 0; i < dim; ++i) {
      f[static_cast<Eigen::Index>(node * dim + i)] += mass[node] * acceleration[i];
    }
  }
}

void add_nodal_force(std::size_t node, std::span<const double> force, VectorRef f) {
  const std::size_t num_nodes = static_cast<std::size_t>(f.size()) / force.size();
  if (node >= num_nodes) {
    throw InputError(
        fmt::format("force on node {}: outside the mesh; must be below {}", node, num_nodes));
  }
  check_finite(force, "nodal force");
  for (std::size_t i = 0; i < force.size(); ++i) {
    f[static_cast<Eigen::Index>(node * force.size() + i)] += force[i];
  }
}

}  // namespace elastogen
