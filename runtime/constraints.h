// Displacement constraints per degree of freedom.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/vector.h"

namespace elastogen {

/// Which degrees of freedom have a given displacement, and which.
class Constraints {
 public:
  /// None constrained.
  Constraints(std::size_t num_nodes, int dim);

  /// Fixes all components of a node: displacement 0.
  /// @throws InputError  node outside the mesh, or already given another displacement; so below
  void fix(std::size_t node);

  /// Fixes one component of a node.
  void fix(std::size_t node, int component);

  /// Gives one component of a node a displacement [m].
  /// @throws InputError  also if the value is not finite
  void prescribe(std::size_t node, int component, double value);

  [[nodiscard]] int dim() const { return dim_; }
  [[nodiscard]] std::size_t num_dofs() const { return constrained_.size(); }
  [[nodiscard]] std::size_t num_constrained() const { return num_constrained_; }
  [[nodiscard]] std::size_t num_free() const { return num_dofs() - num_constrained_; }
  [[nodiscard]] bool is_constrained(std::size_t dof) const { return constrained_[dof] != 0; }
  /// Given displacement of a constrained degree of freedom [m]; 0 for a free one.
  [[nodiscard]] double value(std::size_t dof) const { return values_[dof]; }

  /// Sets u to the given displacements where constrained.
  void impose(VectorRef u) const;
  /// Sets v to 0 where constrained.
  void project(VectorRef v) const;
  /// Sets v to 0 where free.
  void project_constrained(VectorRef v) const;

 private:
  int dim_;
  std::size_t num_constrained_ = 0;
  std::vector<std::uint8_t> constrained_;  // [dof]
  std::vector<double> values_;             // [dof]
};

}  // namespace elastogen
