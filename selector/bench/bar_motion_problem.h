// A bar that starts to hang: waves along it, with an exact solution.
#pragma once

#include <memory>

#include "selector/bench/work_precision_problem.h"

namespace elastogen::selector {

/// An elastic bar clamped at x = 0, at rest, whose weight acts along it from t = 0 on.
struct HangingBar {
  double length = 0;      ///< [m]
  double wave_speed = 0;  ///< sqrt(E / rho) [m/s]
  double gravity = 0;     ///< towards the free end [m/s^2]

  /// Displacement of the free end [m], the solution of u_tt = c^2 u_xx + g by separation:
  ///   u = g L^2 / c^2 (1/2 - 16/pi^3 sum over odd n of sin(n pi/2) cos(n pi c t / 2L) / n^3)
  [[nodiscard]] double end_displacement(double time) const;
  /// The slowest one's [s].
  [[nodiscard]] double period() const { return 4 * length / wave_speed; }
};

/// Error: of the free end's displacement over one period, root of the mean square over that of the
/// exact displacement. The choices' solver is the scheme, their tolerance the time step as a part
/// of the time in which a wave crosses a cell; 0: the scheme's own, by the critical step.
[[nodiscard]] std::unique_ptr<WorkPrecisionProblem> make_bar_motion_problem();

}  // namespace elastogen::selector
