#include "runtime/symplectic_euler.h"

namespace elastogen {

void SymplecticEuler::advance(double time, double h) {
  const Vector force = internal_forces() + load_;
  Vector moved = state_.u;
  motion_.impose(time + h, moved);
  for (Eigen::Index k = 0; k < force.size(); ++k) {
    const double v = constraints_.is_constrained(static_cast<std::size_t>(k))
                         ? (moved[k] - state_.u[k]) / h
                         : (state_.v[k] + h * force[k] / mass_[k]) / (1 + h * options_.damping);
    state_.a[k] = (v - state_.v[k]) / h;
    state_.v[k] = v;
    if (!constraints_.is_constrained(static_cast<std::size_t>(k))) moved[k] += h * v;
  }
  state_.u = moved;
}

}  // namespace elastogen
