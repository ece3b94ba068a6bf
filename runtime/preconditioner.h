// Preconditioners of conjugate gradient on K + A + s D (linear_solver.h).
#pragma once

#include "runtime/vector.h"

namespace elastogen {

/// M, symmetric and positive definite, near K + A + s D. Bound to a model and constraints that must
/// outlive it.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Takes up the model's linearisation point, or decides that what it has is near enough.
  /// @param added  A on all degrees of freedom, or empty
  virtual void update(const Vector& added) = 0;

  /// Takes up the shift s, for the solves that follow.
  /// @return false if K + A + s D is seen not to be positive definite
  [[nodiscard]] virtual bool set_shift(double shift) = 0;

  /// z = M^-1 r, 0 where constrained; r is 0 there.
  /// @return r.z
  virtual double apply(const Vector& r, Vector& z) = 0;

  /// Told after each solve how many iterations it took.
  virtual void note_iterations(int) {}

  /// Forgets what it has of earlier points: what follows depends on later ones only.
  virtual void forget() {}

  /// Diagonal of K + A where it was last looked at.
  [[nodiscard]] virtual const Vector& diagonal() const = 0;

  [[nodiscard]] virtual int factorizations() const { return 0; }
};

}  // namespace elastogen
