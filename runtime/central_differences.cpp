#include "runtime/central_differences.h"

namespace elastogen {

void CentralDifferences::advance(double time, double h) {
  const double alpha = options_.damping;
  const Vector before = state_.u;
  Vector half_step = total_forces();  // the velocity at time + h / 2
  for (Eigen::Index k = 0; k < half_step.size(); ++k) {
    const bool is_free = !constraints_.is_constrained(static_cast<std::size_t>(k));
    half_step[k] = is_free ? state_.v[k] + 0.5 * h * half_step[k] / mass_[k] : 0;
  }
  state_.u += h * half_step;
  motion_.impose(time + h, state_.u);
  // What comes next of the motion: the constrained velocities are central differences, too.
  Vector next = state_.u;
  motion_.impose(time + 2 * h, next);

  forget_forces();
  const Vector force = internal_forces() + load_;
  for (Eigen::Index k = 0; k < force.size(); ++k) {
    if (constraints_.is_constrained(static_cast<std::size_t>(k))) {
      state_.v[k] = (next[k] - before[k]) / (2 * h);
      state_.a[k] = (next[k] - 2 * state_.u[k] + before[k]) / (h * h);
    } else {
      state_.v[k] = (half_step[k] + 0.5 * h * force[k] / mass_[k]) / (1 + 0.5 * h * alpha);
      state_.a[k] = force[k] / mass_[k] - alpha * state_.v[k];
    }
  }
}

}  // namespace elastogen
