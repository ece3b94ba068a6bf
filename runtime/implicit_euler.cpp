#include "runtime/implicit_euler.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/error.h"

namespace elastogen {

ImplicitEuler::ImplicitEuler(Model& model, const Constraints& constraints,
                             const PrescribedMotion& motion, const ConstVectorRef& load,
                             const IntegratorOptions& options, MotionState start)
    : Integrator(model, constraints, motion, load, options, std::move(start)),
      solver_(make_linear_solver(options.linear_solver, model, constraints)) {}

void ImplicitEuler::solve(const Vector& u, double h, const Vector& b, Vector& x) {
  x.setZero(u.size());
  if (constraints_.num_free() == 0) return;
  model_.linearize(u);
  solver_->set_added_diagonal((1 + h * options_.damping) / (h * h) * mass_);
  solver_->update();
  if (!solver_->set_shift(0)) {
    throw WorkError("the step's matrix is not positive definite; take a smaller step");
  }
  const LinearSolveReport report = solver_->solve(b, options_.linear_tolerance, x);
  linear_iterations_ += report.iterations;
  if (!report.positive_definite || !x.allFinite()) {
    throw WorkError("the step's matrix is not positive definite; take a smaller step");
  }
  if (!report.converged) {
    throw WorkError(
        fmt::format("conjugate gradient ended after {} iterations at a relative "
                    "residual of {:.1e}",
                    report.iterations, report.relative_residual));
  }
}

void ImplicitEuler::advance(double time, double h) {
  const MotionState before = state_;
  Vector moved = state_.u;
  motion_.impose(time + h, moved);

  // Velocities without those changes that the system is for.
  Vector velocity = state_.v;
  for (Eigen::Index k = 0; k < velocity.size(); ++k) {
    if (constraints_.is_constrained(static_cast<std::size_t>(k))) {
      velocity[k] = (moved[k] - state_.u[k]) / h;
    }
  }
  Vector right_side = total_forces() / h;
  model_.linearize(state_.u);
  model_.product(velocity, 1, right_side);
  constraints_.project(right_side);
  Vector change;
  solve(state_.u, h, right_side, change);
  state_.v = velocity + change;
  state_.u += h * state_.v;
  motion_.impose(time + h, state_.u);  // to the last bit

  if (options_.newton_iterations > 1) {
    iterate(h, before.u, before.v, state_.u);
    for (Eigen::Index k = 0; k < state_.u.size(); ++k) {
      if (!constraints_.is_constrained(static_cast<std::size_t>(k))) {
        state_.v[k] = (state_.u[k] - before.u[k]) / h;
      }
    }
  }
  state_.a = (state_.v - before.v) / h;
}

void ImplicitEuler::iterate(double h, const Vector& before, const Vector& velocity, Vector& u) {
  Vector forces, residual, change;
  for (int iteration = 1;; ++iteration) {
    evaluate_forces(u, forces);
    const Vector reached = (u - before) / h;
    const Vector inertia = mass_.cwiseProduct((reached - velocity) / h);
    residual = forces + load_ - inertia - options_.damping * mass_.cwiseProduct(reached);
    constraints_.project(residual);
    const double reference = std::max({forces.norm(), load_.norm(), inertia.norm()});
    if (residual.norm() <= options_.newton_tolerance * reference) return;
    if (iteration == options_.newton_iterations) {
      throw WorkError(
          fmt::format("Newton's method is at a relative residual of {:.1e} after {} "
                      "iterations",
                      residual.norm() / reference, iteration));
    }
    solve(u, h, residual, change);
    u += change;
  }
}

}  // namespace elastogen
