// The nodes' blocks of the tangent as preconditioner (block Jacobi).
#pragma once

#include <vector>

#include "runtime/constraints.h"
#include "runtime/model.h"
#include "runtime/preconditioner.h"

namespace elastogen {

class NodeBlocks final : public Preconditioner {
 public:
  NodeBlocks(Model& model, const Constraints& constraints);

  void update(const Vector& added) override;
  [[nodiscard]] bool set_shift(double shift) override;
  double apply(const Vector& r, Vector& z) override;
  [[nodiscard]] const Vector& diagonal() const override { return diagonal_; }

 private:
  template <int Dim>
  void invert_blocks(double shift);
  template <int Dim>
  double multiply(const Vector& r, Vector& z) const;

  Model& model_;
  const Constraints& constraints_;
  std::vector<double> blocks_;    // [node][i][j] of K + A
  std::vector<double> inverses_;  // [node][i][j] of (K + A + s D)^-1 on the free components
  Vector diagonal_, scale_;       // of K + A; D
};

}  // namespace elastogen
