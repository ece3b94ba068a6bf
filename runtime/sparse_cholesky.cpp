#include "runtime/sparse_cholesky.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "runtime/elimination_order.h"
#include "runtime/stopwatch.h"

namespace elastogen {
namespace {

constexpr int inverse_iterations = 3;

}  // namespace

SparseCholesky::SparseCholesky(Model& model, const Constraints& constraints,
                               std::unique_ptr<CholeskyFactor> factor)
    : model_(model),
      constraints_(constraints),
      diagonal_(Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()))),
      free_b_(static_cast<Eigen::Index>(constraints.num_free())),
      free_x_(free_b_.size()),
      factor_(std::move(factor)) {}

// Rows of the free degrees of freedom, node by node.
void SparseCholesky::number_free() {
  const auto dim = static_cast<std::size_t>(model_.dim());
  free_numbers_.assign(model_.num_dofs(), -1);
  std::int32_t next = 0;
  std::vector<std::int32_t> order(model_.num_nodes());
  std::iota(order.begin(), order.end(), 0);
  if (factor_->has_fill()) order = elimination_order(stiffness_, model_.dim());
  for (const std::int32_t node : order) {
    for (std::size_t dof = dim * static_cast<std::size_t>(node), i = 0; i < dim; ++i, ++dof) {
      if (!constraints_.is_constrained(dof)) free_numbers_[dof] = next++;
    }
  }
}

// Lower triangle of the free part of stiffness_ and where its values are.
void SparseCholesky::find_pattern() {
  using Entry = std::pair<int, std::int32_t>;  // row, value of stiffness_
  std::vector<std::vector<Entry>> columns(static_cast<std::size_t>(free_b_.size()));
  std::size_t num_values = 0;
  for (Eigen::Index column = 0; column < stiffness_.cols(); ++column) {
    const std::int32_t free_column = free_numbers_[static_cast<std::size_t>(column)];
    if (free_column < 0) continue;
    for (int k = stiffness_.outerIndexPtr()[column]; k < stiffness_.outerIndexPtr()[column + 1];
         ++k) {
      const std::int32_t free_row =
          free_numbers_[static_cast<std::size_t>(stiffness_.innerIndexPtr()[k])];
      if (free_row < free_column) continue;
      columns[static_cast<std::size_t>(free_column)].emplace_back(free_row, k);
      ++num_values;
    }
  }
  sources_.clear();
  diagonal_values_.clear();
  free_matrix_.resize(free_b_.size(), free_b_.size());
  free_matrix_.resizeNonZeros(static_cast<Eigen::Index>(num_values));
  int* outer = free_matrix_.outerIndexPtr();
  int* inner = free_matrix_.innerIndexPtr();
  *outer = 0;
  for (std::vector<Entry>& column : columns) {
    std::sort(column.begin(), column.end());
    diagonal_values_.push_back(static_cast<std::int32_t>(sources_.size()));
    for (const auto& [row, source] : column) {
      *inner++ = row;
      sources_.push_back(source);
    }
    *++outer = static_cast<int>(sources_.size());
  }
}

void SparseCholesky::update() {
  {
    const Stopwatch watch(times_.assembly);
    model_.assemble(stiffness_);
    for (Eigen::Index k = 0; k < diagonal_.size(); ++k) diagonal_[k] = stiffness_.coeff(k, k);
    if (added_diagonal_.size() > 0) diagonal_ += added_diagonal_;
  }
  if (sources_.empty()) {
    const Stopwatch watch(times_.factorization);
    number_free();
    find_pattern();
    factor_->analyze(free_matrix_);
  }
}

bool SparseCholesky::set_shift(double shift) {
  const Stopwatch watch(times_.factorization);
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    free_matrix_.valuePtr()[k] = stiffness_.valuePtr()[sources_[k]];
  }
  Vector added = added_diagonal_;
  if (shift > 0) {
    if (added.size() == 0) added = Vector::Zero(diagonal_.size());
    added += shift * shift_scale(diagonal_);
  }
  if (added.size() > 0) {
    for (std::size_t dof = 0; dof < free_numbers_.size(); ++dof) {
      if (free_numbers_[dof] < 0) continue;
      const auto value = diagonal_values_[static_cast<std::size_t>(free_numbers_[dof])];
      free_matrix_.valuePtr()[value] += added[static_cast<Eigen::Index>(dof)];
    }
  }
  shift_ = shift;
  ++factorizations_;
  return factor_->factorize(free_matrix_);
}

void SparseCholesky::take_free(const ConstVectorRef& b) {
  for (std::size_t dof = 0; dof < free_numbers_.size(); ++dof) {
    if (free_numbers_[dof] >= 0) free_b_[free_numbers_[dof]] = b[static_cast<Eigen::Index>(dof)];
  }
}

void SparseCholesky::give_free(VectorRef x) const {
  x.setZero();
  for (std::size_t dof = 0; dof < free_numbers_.size(); ++dof) {
    if (free_numbers_[dof] >= 0) x[static_cast<Eigen::Index>(dof)] = free_x_[free_numbers_[dof]];
  }
}

LinearSolveReport SparseCholesky::solve(const ConstVectorRef& b, double, VectorRef x) {
  LinearSolveReport report;
  substitute(b, x);
  // A pivot that is not a number passes Eigen's test of its sign, but not this one.
  report.positive_definite = free_x_.allFinite();
  report.converged = report.positive_definite;
  if (shift_ > 0 && report.positive_definite) report.lowest_curvature = lowest_curvature();
  return report;
}

void SparseCholesky::substitute(const ConstVectorRef& b, VectorRef x) {
  const Stopwatch watch(times_.solve);
  take_free(b);
  factor_->solve(free_b_, free_x_);
  give_free(x);
}

// By inverse iteration with the factor of K + A + s D, from the mode found last, else from the
// solution in free_x_, where modes that are hardly stiff prevail.
double SparseCholesky::lowest_curvature() {
  const Stopwatch watch(times_.solve);
  take_free(shift_scale(diagonal_));
  const Vector scale = free_b_;
  if (mode_.size() == 0) mode_ = free_x_;
  double quotient = 0;
  for (int iteration = 0; iteration < inverse_iterations; ++iteration) {
    free_b_ = scale.cwiseProduct(mode_);
    factor_->solve(free_b_, mode_);
    const double length = mode_.dot(scale.cwiseProduct(mode_));
    quotient = mode_.dot(free_b_) / length - shift_;
    mode_ /= std::sqrt(length);
  }
  return quotient;
}

void SparseCholesky::solve_roughly(const ConstVectorRef& b, VectorRef x) {
  const Stopwatch watch(times_.solve);
  take_free(b);
  factor_->solve_roughly(free_b_, free_x_);
  give_free(x);
}

}  // namespace elastogen
