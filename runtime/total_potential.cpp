#include "runtime/total_potential.h"

#include <algorithm>
#include <cmath>

#include "runtime/stopwatch.h"

namespace elastogen {
namespace {

constexpr double sufficient_decrease = 1e-4;
constexpr double smallest_step = 1e-10;

// Minimum of the parabola through the potential's value and slope at 0 and its value at `step`,
// kept within a tenth and a half of the step.
double interpolate(double step, double slope, double difference) {
  const double excess = difference - slope * step;
  const double minimum = excess > 0 ? -slope * step * step / (2 * excess) : step;
  return std::clamp(minimum, 0.1 * step, 0.5 * step);
}

}  // namespace

TotalPotential::TotalPotential(Model& model, const Constraints& constraints,
                               const ConstVectorRef& full_load)
    : model_(model), constraints_(constraints), full_load_(full_load), load_(full_load) {}

void TotalPotential::set_load_factor(double factor) { load_ = factor * full_load_; }

bool TotalPotential::evaluate_energy(StaticState& state) {
  const Stopwatch watch(seconds_);
  ++num_energy_evaluations_;
  state.energy = model_.energy(state.u);
  state.potential = state.energy - dot(load_, state.u, model_.num_threads());
  return std::isfinite(state.potential) && model_.status().ok();
}

bool TotalPotential::evaluate_forces(StaticState& state) {
  const Stopwatch watch(seconds_);
  state.forces.setZero(state.u.size());
  model_.forces(state.u, state.forces);
  state.residual = state.forces + load_;
  constraints_.project(state.residual);
  state.residual_norm = norm(state.residual, model_.num_threads());
  return std::isfinite(state.residual_norm) && model_.status().ok();
}

double TotalPotential::rounding(const StaticState& state) const {
  // 64: a kernel's own error of some ulp, and the elements' errors partly adding up.
  return 64 * model_.epsilon() *
         (std::abs(state.energy) + std::abs(state.energy - state.potential));
}

LineSearchOutcome TotalPotential::search(const StaticState& start, const Vector& direction,
                                         bool positive_definite, StaticState& trial, double& step) {
  const double slope = -dot(start.residual, direction, model_.num_threads());
  const double noise = rounding(start);
  const bool can_tell = std::abs(slope) > noise;  // even the whole step may drown in rounding
  for (step = 1; step >= smallest_step;) {
    trial.u = start.u + step * direction;
    if (!evaluate_energy(trial)) {
      step *= 0.25;
      continue;
    }
    const double difference = trial.potential - start.potential;
    const bool drowned = !can_tell && std::abs(difference) <= noise;
    if ((drowned || difference <= sufficient_decrease * step * slope) && evaluate_forces(trial)) {
      if (!drowned || !positive_definite || trial.residual_norm < start.residual_norm) {
        return LineSearchOutcome::accepted;
      }
    }
    if (drowned && step < 0.1) return LineSearchOutcome::at_rounding;
    step = interpolate(step, slope, difference);
  }
  return can_tell ? LineSearchOutcome::failed : LineSearchOutcome::at_rounding;
}

}  // namespace elastogen
