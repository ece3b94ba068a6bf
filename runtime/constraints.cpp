#include "runtime/constraints.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/error.h"

namespace elastogen {

Constraints::Constraints(std::size_t num_nodes, int dim)
    : dim_(dim),
      constrained_(num_nodes * static_cast<std::size_t>(dim), 0),
      values_(constrained_.size(), 0.0) {}

void Constraints::fix(std::size_t node) {
  for (int i = 0; i < dim_; ++i) prescribe(node, i, 0);
}

void Constraints::fix(std::size_t node, int component) { prescribe(node, component, 0); }

void Constraints::prescribe(std::size_t node, int component, double value) {
  const std::size_t dim = static_cast<std::size_t>(dim_);
  if (node >= num_dofs() / dim) {
    throw InputError(fmt::format("constraint on node {}: outside the mesh; must be below {}", node,
                                 num_dofs() / dim));
  }
  if (component < 0 || component >= dim_) {
    throw InputError(fmt::format("constraint on node {}: component {}; must be in 0 ... {}", node,
                                 component, dim_ - 1));
  }
  if (!std::isfinite(value)) {
    throw InputError(
        fmt::format("constraint on node {}: displacement {} of component {}; must be "
                    "finite",
                    node, value, component));
  }
  const std::size_t dof = node * dim + static_cast<std::size_t>(component);
  if (constrained_[dof] != 0 && values_[dof] != value) {
    throw InputError(fmt::format(
        "constraint on node {}: component {} is given the displacements {} and {}; give it one",
        node, component, values_[dof], value));
  }
  if (constrained_[dof] == 0) ++num_constrained_;
  constrained_[dof] = 1;
  values_[dof] = value;
}

void Constraints::impose(VectorRef u) const {
  for (std::size_t dof = 0; dof < num_dofs(); ++dof) {
    if (constrained_[dof] != 0) u[static_cast<Eigen::Index>(dof)] = values_[dof];
  }
}

void Constraints::project(VectorRef v) const {
  for (std::size_t dof = 0; dof < num_dofs(); ++dof) {
    if (constrained_[dof] != 0) v[static_cast<Eigen::Index>(dof)] = 0;
  }
}

void Constraints::project_constrained(VectorRef v) const {
  for (std::size_t dof = 0; dof < num_dofs(); ++dof) {
    if (constrained_[dof] == 0) v[static_cast<Eigen::Index>(dof)] = 0;
  }
}

}  // namespace elastogen
