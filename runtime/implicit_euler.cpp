#include "runtime/implicit_euler.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/error.h"

namespace elastogen {

ImplicitEuler::ImplicitEuler(Model& model, const Constraints& constraints,
                             const PrescribedMotion& motion, const ConstVectorRef& load,
                             const IntegratorOptions& options, MotionState start)
    : Integrator(model, constraints, motion, load, options, std::move(start)),
      solver_(make_linear_solver(going_on(options.linear_solver, state_.fell_back), model,
                                 constraints)) {}

void ImplicitEuler::solve(const Vector& u, double h, const Vector& b, const Vector& v, Vector& x) {
  if (constraints_.num_free() == 0) {
    x.setZero();
    return;
  }
  solver_->set_added_diagonal((1 + h * options_.damping) / (h * h) * mass_);
  if (options_.projection != TangentProjection::always) {
    model_.linearize(u);
    if (try_solve(b, v, x)) return;
  }
  if (options_.projection != TangentProjection::never) {
    model_.linearize(u, TangentForm::semidefinite);
    if (try_solve(b, v, x)) return;
  }
  throw WorkError("the step's matrix is not positive definite; take a smaller step");
}

// False if the system is not positive definite.
bool ImplicitEuler::try_solve(const Vector& b, const Vector& v, Vector& x) {
  solver_->update();
  if (!solver_->set_shift(0)) return false;
  Vector right_side = b;
  if (v.size() > 0) model_.product(v, 1, right_side);
  constraints_.project(right_side);
  const LinearSolveReport report = solver_->solve(right_side, options_.linear_tolerance, x);
  linear_iterations_ += report.iterations;
  if (!report.positive_definite || !x.allFinite()) return false;
  if (!report.converged) {
    throw WorkError(
        fmt::format("conjugate gradient ended after {} iterations at a relative "
                    "residual of {:.1e}",
                    report.iterations, report.relative_residual));
  }
  return true;
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
  // A guess: in smooth motions the acceleration goes on as it did.
  Vector change = h * (2 * state_.a - state_.a_before);
  constraints_.project(change);
  solve(state_.u, h, total_forces() / h, velocity, change);
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
  state_.a_before = before.a;
  state_.fell_back = solver_->kind() != options_.linear_solver.kind;
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
    change.setZero(u.size());
    solve(u, h, residual, {}, change);
    u += change;
  }
}

}  // namespace elastogen
