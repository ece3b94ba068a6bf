#include "runtime/node_blocks.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "runtime/linear_solver.h"

namespace elastogen {
namespace {

// Pieces in which a reduction is summed, so that it does not depend on the number of threads.
constexpr std::size_t num_pieces = 64;

}  // namespace

NodeBlocks::NodeBlocks(Model& model, const Constraints& constraints)
    : model_(model),
      constraints_(constraints),
      diagonal_(Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()))) {}

void NodeBlocks::update(const Vector& added) {
  model_.diagonal_blocks(blocks_);
  const std::size_t dim = static_cast<std::size_t>(model_.dim());
  for (std::size_t dof = 0; dof < model_.num_dofs(); ++dof) {
    if (added.size() > 0) {
      blocks_[dof * dim + dof % dim] += added[static_cast<Eigen::Index>(dof)];
    }
    diagonal_[static_cast<Eigen::Index>(dof)] = blocks_[dof * dim + dof % dim];
  }
  scale_ = shift_scale(diagonal_);
}

bool NodeBlocks::set_shift(double shift) {
  inverses_.resize(blocks_.size());
  if (model_.dim() == 3) {
    invert_blocks<3>(shift);
  } else {
    invert_blocks<2>(shift);
  }
  return true;
}

template <int Dim>
void NodeBlocks::invert_blocks(double shift) {
  using Block = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
  const std::size_t num_nodes = model_.num_nodes();
#pragma omp parallel for schedule(static) num_threads(model_.num_threads())
  for (std::size_t node = 0; node < num_nodes; ++node) {
    Block block = Eigen::Map<const Block>(blocks_.data() + node * Dim * Dim);
    for (std::size_t i = 0; i < Dim; ++i) {
      const std::size_t dof = node * Dim + i;
      const auto k = static_cast<Eigen::Index>(i);
      block(k, k) += shift * scale_[static_cast<Eigen::Index>(dof)];
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
        inverse(k, k) = 1 / ((1 + shift) * scale_[static_cast<Eigen::Index>(node * Dim + i)]);
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

double NodeBlocks::apply(const Vector& r, Vector& z) {
  return model_.dim() == 3 ? multiply<3>(r, z) : multiply<2>(r, z);
}

template <int Dim>
double NodeBlocks::multiply(const Vector& residual, Vector& preconditioned) const {
  const std::size_t num_nodes = model_.num_nodes();
  const std::size_t length = (num_nodes + num_pieces - 1) / num_pieces;
  const double* inverses = inverses_.data();
  const double* r = residual.data();
  double* z = preconditioned.data();
  std::array<double, num_pieces> sums;
#pragma omp parallel for schedule(static) \
    num_threads(model_.num_threads()) if (residual.size() > parallel_length)
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

}  // namespace elastogen
