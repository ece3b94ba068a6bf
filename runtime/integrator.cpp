#include "runtime/integrator.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "runtime/central_differences.h"
#include "runtime/error.h"
#include "runtime/implicit_euler.h"
#include "runtime/symplectic_euler.h"

namespace elastogen {
namespace {

void check_options(const IntegratorOptions& options) {
  const auto must = [](const char* name, double value, bool good, const char* allowed) {
    if (!good || !std::isfinite(value)) {
      throw InputError(fmt::format("integrator: {} = {}; must be {}", name, value, allowed));
    }
  };
  must("step", options.step, options.step > 0, "greater than 0");
  must("damping", options.damping, options.damping >= 0, "at least 0");
  must("linear_tolerance", options.linear_tolerance,
       options.linear_tolerance > 0 && options.linear_tolerance < 1, "in (0, 1)");
  must("newton_tolerance", options.newton_tolerance,
       options.newton_tolerance > 0 && options.newton_tolerance < 1, "in (0, 1)");
  must("newton_iterations", options.newton_iterations, options.newton_iterations >= 1,
       "at least 1");
  must("max_halvings", options.max_halvings, options.max_halvings >= 0, "at least 0");
}

void check_sizes(const Model& model, const Constraints& constraints, const ConstVectorRef& load,
                 const MotionState& start) {
  const auto n = static_cast<Eigen::Index>(model.num_dofs());
  if (constraints.num_dofs() != model.num_dofs() || load.size() != n || start.u.size() != n ||
      start.v.size() != n || start.a.size() != n || start.a_before.size() != n) {
    throw InternalError(fmt::format(
        "integrator: constraints, load, u, v, a, a_before have {}, {}, {}, {}, {}, {} values, the "
        "model {}",
        constraints.num_dofs(), load.size(), start.u.size(), start.v.size(), start.a.size(),
        start.a_before.size(), n));
  }
}

}  // namespace

std::string_view scheme_name(IntegrationScheme scheme) {
  constexpr std::array<std::string_view, 3> names = {"implicit_euler", "symplectic_euler",
                                                     "central_differences"};
  return names[static_cast<std::size_t>(scheme)];
}

Integrator::Integrator(Model& model, const Constraints& constraints, const PrescribedMotion& motion,
                       const ConstVectorRef& load, const IntegratorOptions& options,
                       MotionState start)
    : model_(model),
      constraints_(constraints),
      motion_(motion),
      load_(load),
      options_(options),
      state_(std::move(start)),
      mass_(static_cast<Eigen::Index>(model.num_dofs())) {
  const auto dim = static_cast<std::size_t>(model.dim());
  for (std::size_t dof = 0; dof < model.num_dofs(); ++dof) {
    const double mass = model.lumped_mass()[dof / dim];
    if (!(mass > 0) && !constraints.is_constrained(dof)) {
      throw InputError(fmt::format(
          "node {} has the mass {} kg and is free: motion in time needs a density greater than 0",
          dof / dim, mass));
    }
    mass_[static_cast<Eigen::Index>(dof)] = mass;
  }
  motion_.impose(time(), state_.u);
}

void Integrator::evaluate_forces(const Vector& u, Vector& forces) {
  forces.setZero(u.size());
  model_.forces(u, forces);
  ++force_evaluations_;
  if (!model_.status().ok()) throw WorkError(model_.describe(model_.status()));
  if (!forces.allFinite()) throw WorkError("the internal forces are not finite");
}

const Vector& Integrator::internal_forces() {
  if (!forces_known_) evaluate_forces(state_.u, forces_);
  forces_known_ = true;
  return forces_;
}

Vector Integrator::total_forces() {
  return internal_forces() + load_ - options_.damping * mass_.cwiseProduct(state_.v);
}

Vector Integrator::reactions() {
  Vector reactions = mass_.cwiseProduct(state_.a) - total_forces();
  constraints_.project_constrained(reactions);
  return reactions;
}

double Integrator::kinetic_energy() const {
  return 0.5 * dot(mass_.cwiseProduct(state_.v), state_.v, model_.num_threads());
}

void Integrator::advance_or_halve(double time, double h, int halvings_left) {
  const MotionState before = state_;
  try {
    advance(time, h);
    forget_forces();
    // A bad element shows now, while the step can still be taken back.
    (void)internal_forces();
  } catch (const WorkError&) {
    if (!can_halve() || halvings_left == 0) throw;
    state_ = before;
    forget_forces();
    ++halvings_;
    advance_or_halve(time, h / 2, halvings_left - 1);
    advance_or_halve(time + h / 2, h / 2, halvings_left - 1);
  }
}

void Integrator::step() {
  const MotionState before = state_;
  try {
    advance_or_halve(time(), options_.step, options_.max_halvings);
  } catch (const WorkError& error) {
    state_ = before;
    forget_forces();
    throw WorkError(fmt::format("step {} of {} from t = {:.6g} s: {}", before.step + 1,
                                scheme_name(options_.scheme), time(), error.what()));
  }
  ++state_.step;
}

MotionState start_of_motion(const Model& model, std::span<const double> velocity) {
  const auto dim = static_cast<std::size_t>(model.dim());
  if (velocity.size() != dim) {
    throw InternalError(
        fmt::format("start of motion: {} components of velocity in {}D", velocity.size(), dim));
  }
  MotionState state;
  state.u = state.v = state.a = state.a_before =
      Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  for (std::size_t dof = 0; dof < model.num_dofs(); ++dof) {
    state.v[static_cast<Eigen::Index>(dof)] = velocity[dof % dim];
  }
  return state;
}

std::unique_ptr<Integrator> make_integrator(Model& model, const Constraints& constraints,
                                            const PrescribedMotion& motion,
                                            const ConstVectorRef& load,
                                            const IntegratorOptions& options, MotionState start) {
  check_options(options);
  check_sizes(model, constraints, load, start);
  if (!load.allFinite()) throw InputError("integrator: the load is not finite");
  switch (options.scheme) {
    case IntegrationScheme::symplectic_euler:
      return std::make_unique<SymplecticEuler>(model, constraints, motion, load, options,
                                               std::move(start));
    case IntegrationScheme::central_differences:
      return std::make_unique<CentralDifferences>(model, constraints, motion, load, options,
                                                  std::move(start));
    case IntegrationScheme::implicit_euler:
      break;
  }
  return std::make_unique<ImplicitEuler>(model, constraints, motion, load, options,
                                         std::move(start));
}

}  // namespace elastogen
