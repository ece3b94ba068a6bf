// The diagonal shift of Newton's method, followed from tangent to tangent.
#pragma once

#include <optional>

namespace elastogen {

/// Chooses s so that K + s D is positive definite and no stiffer than need be.
///
/// With the lowest eigenvalue -l < 0 of K x = lambda D x, s = 2 l would make its mode as stiff as
/// it is unstable, as taking the eigenvalue's absolute value does; 1.5 l is a little bolder, while
/// other modes, in slender bodies a million times as stiff, stay as they are. Any fixed shift is
/// either too small for thick bodies or turns Newton's method on slender ones, whose bending
/// stiffness is D times the fourth power of their slenderness, into steepest descent. l is
/// estimated by the solver (LinearSolveReport::lowest_curvature); while nothing is known, shifts
/// grow from `smallest`. Sources: J. Nocedal & S. Wright, Numerical Optimization, 2nd ed.,
/// section 3.4 (modified Hessians, algorithm 3.3) and section 4.3 (-lambda_1 of the trust region's
/// hard case).
class TangentShift {
 public:
  [[nodiscard]] double value() const { return value_; }

  /// Forgets what it knows: no shift.
  void restart() { *this = {}; }

  /// For a new tangent: none where the last one is known to need none, else what that needed.
  void take_next_tangent();

  /// After K + s D was found not to be positive definite.
  /// @return false if s would be too large to be of use
  [[nodiscard]] bool grow();

  /// Takes up an estimate from above of the lowest eigenvalue.
  void note(std::optional<double> lowest_curvature);

  /// After a solve: takes a smaller shift where this one is many times what is needed.
  /// @return whether it did, once per tangent
  [[nodiscard]] bool refine();

 private:
  double value_ = 0;
  double last_ = 0;    // of the tangent before
  double lowest_ = 0;  // estimate of the lowest eigenvalue, if negative; else 0
  bool may_refine_ = true;
};

}  // namespace elastogen
