#include "runtime/conjugate_gradient.h"

#include <algorithm>
#include <utility>

#include "runtime/stopwatch.h"

namespace elastogen {

ConjugateGradient::ConjugateGradient(LinearSolverKind kind, Model& model,
                                     const Constraints& constraints,
                                     std::unique_ptr<Preconditioner> preconditioner,
                                     int max_iterations)
    : kind_(kind),
      model_(model),
      constraints_(constraints),
      max_iterations_(max_iterations),
      preconditioner_(std::move(preconditioner)) {
  const auto n = static_cast<Eigen::Index>(model.num_dofs());
  for (Vector* v : {&residual_, &preconditioned_, &direction_, &product_}) *v = Vector::Zero(n);
  if (max_iterations_ <= 0) {
    max_iterations_ = static_cast<int>(std::min<std::size_t>(10 * constraints.num_free(), 1000000));
  }
}

void ConjugateGradient::update() {
  const Stopwatch watch(times_.assembly);
  preconditioner_->update(added_diagonal_);
}

bool ConjugateGradient::set_shift(double shift) {
  const Stopwatch watch(times_.factorization);
  shift_ = shift;
  if (shift > 0) scale_ = shift_scale(preconditioner_->diagonal());
  return preconditioner_->set_shift(shift);
}

// product_ = (K + A + s D) direction_ on the free degrees of freedom.
void ConjugateGradient::multiply() {
  const Stopwatch watch(times_.product);
  if (shift_ == 0) {
    product_.setZero();
  } else {
    product_ = shift_ * scale_.cwiseProduct(direction_);
  }
  if (added_diagonal_.size() > 0) product_ += added_diagonal_.cwiseProduct(direction_);
  model_.product(direction_, -1, product_);
  constraints_.project(product_);
}

// Sets residual_ = b - A x, after making x 0 where it is no better than that. Returns its norm.
double ConjugateGradient::start(const ConstVectorRef& b, double b_norm, VectorRef x) {
  const int threads = model_.num_threads();
  constraints_.project(x);
  if (norm(x, threads) != 0) {
    direction_ = x;
    multiply();
    axpy(-1, product_, residual_, threads);
    const double r_norm = norm(residual_, threads);
    if (r_norm < b_norm) return r_norm;
    residual_ = b;
    constraints_.project(residual_);
  }
  x.setZero();
  return b_norm;
}

// Rayleigh quotient of direction_, where it tells something. `curvature` is that of K + A + s D.
void ConjugateGradient::note_curvature(double curvature, LinearSolveReport& report) const {
  if (shift_ == 0 && curvature > 0) return;
  const Vector& d = direction_;
  const double length = shift_ > 0
                            ? d.cwiseProduct(scale_).dot(d)
                            : d.cwiseProduct(shift_scale(preconditioner_->diagonal())).dot(d);
  const double quotient = curvature / length - shift_;
  report.lowest_curvature = std::min(quotient, report.lowest_curvature.value_or(quotient));
}

LinearSolveReport ConjugateGradient::solve(const ConstVectorRef& b, double tolerance, VectorRef x) {
  const double product_before = times_.product;
  double elapsed = 0;
  LinearSolveReport report;
  {
    const Stopwatch watch(elapsed);
    const int threads = model_.num_threads();
    residual_ = b;
    constraints_.project(residual_);
    const double b_norm = norm(residual_, threads);
    double r_norm = start(b, b_norm, x);
    double rz = 0;
    while (r_norm > tolerance * b_norm && report.iterations < max_iterations_) {
      const double next = preconditioner_->apply(residual_, preconditioned_);
      if (report.iterations == 0) {
        direction_ = preconditioned_;
      } else {
        xpby(preconditioned_, next / rz, direction_, threads);
      }
      rz = next;
      multiply();
      const double curvature = dot(direction_, product_, threads);
      ++report.iterations;
      note_curvature(curvature, report);
      // Written so that a curvature that is not a number counts as bad too.
      if (!(curvature > 0)) {
        report.positive_definite = false;
        break;
      }
      const double alpha = rz / curvature;
      axpy(alpha, direction_, x, threads);
      axpy(-alpha, product_, residual_, threads);
      r_norm = norm(residual_, threads);
    }
    report.converged = report.positive_definite && r_norm <= tolerance * b_norm;
    report.relative_residual = b_norm > 0 ? r_norm / b_norm : 0;
  }
  preconditioner_->note_iterations(report.iterations);
  times_.solve += elapsed - (times_.product - product_before);
  return report;
}

}  // namespace elastogen
