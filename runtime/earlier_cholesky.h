// The Cholesky factor of an earlier tangent, complete or not, as preconditioner.
#pragma once

#include <memory>

#include "runtime/constraints.h"
#include "runtime/model.h"
#include "runtime/preconditioner.h"
#include "runtime/sparse_cholesky.h"

namespace elastogen {

/// Factorises where it has no factor, and anew when a solve took so many iterations more than the
/// first with the present factor that a factorisation would have cost less.
class EarlierCholesky final : public Preconditioner {
 public:
  EarlierCholesky(Model& model, const Constraints& constraints,
                  std::unique_ptr<CholeskyFactor> factor);

  void update(const Vector& added) override;
  [[nodiscard]] bool set_shift(double shift) override;
  double apply(const Vector& r, Vector& z) override;
  void note_iterations(int iterations) override;
  void forget() override { is_stale_ = true; }
  [[nodiscard]] const Vector& diagonal() const override { return cholesky_.diagonal(); }
  [[nodiscard]] int factorizations() const override { return cholesky_.factorizations(); }

 private:
  Model& model_;
  SparseCholesky cholesky_;
  bool is_stale_ = true;     // the next update shall look at the tangent
  bool has_factor_ = false;  // of the last tangent looked at, with some shift
  bool is_bounded_ = false;  // something was added to the tangent's diagonal
  bool is_new_ = false;      // nothing was solved with it
  int iterations_when_new_ = 0;
};

}  // namespace elastogen
