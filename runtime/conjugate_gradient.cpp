#include "runtime/conjugate_gradient.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/stopwatch.h"

namespace elastogen {
namespace {

// Pieces in which a reduction is summed, so that it does not depend on the number of threads.
constexpr std::size_t num_pieces = 64;

}  // namespace

ConjugateGradient::ConjugateGradient(Model& model, const Constraints& constraints,
                                     int max_iterations)
    : model_(model), constraints_(constraints), max_iterations_(max_iterations) {
  const auto n = static_cast<Eigen::Index>(model.num_dofs());
  for (Vector* v : {&diagonal_, &scale_, &residual_, &preconditioned_, &direction_, &product_}) {
    *v = Vector::Zero(n);
  }
  if (max_iterations_ <= 0) {
    max_iterations_ = static_cast<int>(std::min<std::size_t>(10 * constraints.num_free(), 1000000));
  }
}

void ConjugateGradient::update() {
  const Stopwatch watch(times_.assembly);
  model_.diagonal_blocks(blocks_);
  const std::size_t dim = static_cast<std::size_t>(model_.dim());
  for (std::size_t dof = 0; dof < model_.num_dofs(); ++dof) {
    if (added_diagonal_.size() > 0) {
      blocks_[dof * dim + dof % dim] += added_diagonal_[static_cast<Eigen::Index>(dof)];
    }
    diagonal_[static_cast<Eigen::Index>(dof)] = blocks_[dof * dim + dof % dim];
  }
  scale_ = shift_scale(diagonal_);
}

bool ConjugateGradient::set_shift(double shift) {
  const Stopwatch watch(times_.factorization);
  shift_ = shift;
  inverses_.resize(blocks_.size());
  if (model_.dim() == 3) {
    invert_blocks<3>();
  } else {
    invert_blocks<2>();
  }
  return true;
}

template <int Dim>
void ConjugateGradient::invert_blocks() {
  using Block = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
  const std::size_t num_nodes = model_.num_nodes();
#pragma omp parallel for schedule(static) num_threads(model_.num_threads())
  for (std::size_t node = 0; node < num_nodes; ++node) {
    Block block = Eigen::Map<const Block>(blocks_.data() + node * Dim * Dim);
    for (std::size_t i = 0; i < Dim; ++i) {
      const std::size_t dof = node * Dim + i;
      const auto k = static_cast<Eigen::Index>(i);
      block(k, k) += shift_ * scale_[static_cast<Eigen::Index>(dof)];
      if (constraints_.is_constrained(dof)) {
        block.row(k).setZero();
        block.col(k).setZero();
        block(k, k) = 1;
      }
    }
    const Eigen::LLT<Block> factor(block);
    Block inverse;
    if (factor.info() == Eigen::Success) {
      inverse = factor.solve(Block::Identity());
    } else {
      // Only a positive definite preconditioner keeps the method sound.
      inverse.setZero();
      for (std::size_t i = 0; i < Dim; ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        inverse(k, k) = 1 / ((1 + shift_) * scale_[static_cast<Eigen::Index>(node * Dim + i)]);
      }
    }
    for (std::size_t i = 0; i < Dim; ++i) {
      // Zero here keeps constrained degrees of freedom at 0 in every vector of the method.
      if (constraints_.is_constrained(node * Dim + i)) {
        inverse.row(static_cast<Eigen::Index>(i)).setZero();
      }
    }
    Eigen::Map<Block>(inverses_.data() + node * Dim * Dim) = inverse;
  }
}

// preconditioned_ = M^-1 residual_; returns their product.
template <int Dim>
double ConjugateGradient::precondition() {
  const std::size_t num_nodes = model_.num_nodes();
  const std::size_t length = (num_nodes + num_pieces - 1) / num_pieces;
  const double* inverses = inverses_.data();
  const double* r = residual_.data();
  double* z = preconditioned_.data();
  std::array<double, num_pieces> sums;
#pragma omp parallel for schedule(static) \
    num_threads(model_.num_threads()) if (residual_.size() > parallel_length)
  for (std::size_t piece = 0; piece < num_pieces; ++piece) {
    double sum = 0;
    const std::size_t end = std::min(num_nodes, (piece + 1) * length);
    for (std::size_t node = piece * length; node < end; ++node) {
      const double* m = inverses + node * Dim * Dim;
      for (int i = 0; i < Dim; ++i) {
        double value = 0;
        for (int j = 0; j < Dim; ++j)
          value += m[i * Dim + j] * r[node * Dim + static_cast<std::size_t>(j)];
        z[node * Dim + static_cast<std::size_t>(i)] = value;
        sum += value * r[node * Dim + static_cast<std::size_t>(i)];
      }
    }
    sums[piece] = sum;
  }
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
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

LinearSolveReport ConjugateGradient::solve(const ConstVectorRef& b, double tolerance, VectorRef x) {
  const double product_before = times_.product;
  double elapsed = 0;
  LinearSolveReport report;
  {
    const Stopwatch watch(elapsed);
    const int threads = model_.num_threads();
    const auto precondition_residual = [&] {
      return model_.dim() == 3 ? precondition<3>() : precondition<2>();
    };
    x.setZero();
    residual_ = b;
    constraints_.project(residual_);
    const double b_norm = norm(residual_, threads);
    double r_norm = b_norm;
    double rz = precondition_residual();
    direction_ = preconditioned_;
    while (r_norm > tolerance * b_norm && report.iterations < max_iterations_) {
      multiply();
      const double curvature = dot(direction_, product_, threads);
      ++report.iterations;
      // Written so that a curvature that is not a number counts as bad too.
      if (!(curvature > 0)) {
        report.positive_definite = false;
        break;
      }
      const double alpha = rz / curvature;
      axpy(alpha, direction_, x, threads);
      axpy(-alpha, product_, residual_, threads);
      r_norm = norm(residual_, threads);
      const double next = precondition_residual();
      xpby(preconditioned_, next / rz, direction_, threads);
      rz = next;
    }
    report.converged = report.positive_definite && r_norm <= tolerance * b_norm;
    report.relative_residual = b_norm > 0 ? r_norm / b_norm : 0;
  }
  times_.solve += elapsed - (times_.product - product_before);
  return report;
}

}  // namespace elastogen
