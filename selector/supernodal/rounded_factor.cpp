#include "selector/supernodal/rounded_factor.h"

#include <algorithm>

// A version for each of these instruction sets, chosen when the library is loaded.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define FOR_EACH_PROCESSOR \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FOR_EACH_PROCESSOR
#endif

namespace elastogen {
namespace {

// Columns that are gone through together, so that z is read and written once for all of them.
constexpr int together = 4;

/// z := what is left of z after substitution with a block's columns: the first num_columns numbers
/// solved for, the others less their share.
FOR_EACH_PROCESSOR
void substitute_forwards(int num_columns, int num_rows, const float* numbers, double* z) {
  for (int first = 0; first < num_columns; first += together) {
    const int last = std::min(first + together, num_columns);
    double x[together] = {};
    const float* column[together];
    for (int k = 0; k < together; ++k) {
      // Where there are fewer, the last column again, times 0.
      const int j = std::min(first + k, last - 1);
      column[k] = numbers + static_cast<std::ptrdiff_t>(j) * num_rows;
      if (first + k != j) continue;
      z[j] /= static_cast<double>(column[k][j]);
      x[k] = z[j];
      for (int i = j + 1; i < last; ++i) z[i] -= static_cast<double>(column[k][i]) * x[k];
    }
    for (int i = last; i < num_rows; ++i) {
      z[i] -=
          (static_cast<double>(column[0][i]) * x[0] + static_cast<double>(column[1][i]) * x[1]) +
          (static_cast<double>(column[2][i]) * x[2] + static_cast<double>(column[3][i]) * x[3]);
    }
  }
}

/// The transpose, from the last column to the first.
FOR_EACH_PROCESSOR
void substitute_backwards(int num_columns, int num_rows, const float* numbers, double* z) {
  for (int last = num_columns; last > 0; last -= together) {
    const int first = std::max(last - together, 0);
    const float* column[together];
    for (int k = 0; k < together; ++k) {
      column[k] = numbers + static_cast<std::ptrdiff_t>(std::min(first + k, last - 1)) * num_rows;
    }
    double sum0 = 0, sum1 = 0, sum2 = 0, sum3 = 0;
#pragma omp simd reduction(+ : sum0, sum1, sum2, sum3)
    for (int i = last; i < num_rows; ++i) {
      sum0 += static_cast<double>(column[0][i]) * z[i];
      sum1 += static_cast<double>(column[1][i]) * z[i];
      sum2 += static_cast<double>(column[2][i]) * z[i];
      sum3 += static_cast<double>(column[3][i]) * z[i];
    }
    const double sums[together] = {sum0, sum1, sum2, sum3};
    for (int j = last - 1; j >= first; --j) {
      double sum = sums[j - first];
      for (int i = j + 1; i < last; ++i) sum += static_cast<double>(column[j - first][i]) * z[i];
      z[j] = (z[j] - sum) / static_cast<double>(column[j - first][j]);
    }
  }
}

}  // namespace

RoundedFactor::RoundedFactor(const cholmod_factor& factor) {
  const auto* const permutation = static_cast<const int*>(factor.Perm);
  const auto* const columns = static_cast<const int*>(factor.super);
  const auto* const row_starts = static_cast<const int*>(factor.pi);
  const auto* const number_starts = static_cast<const int*>(factor.px);
  const auto* const rows = static_cast<const int*>(factor.s);
  const auto* const numbers = static_cast<const double*>(factor.x);
  permutation_.assign(permutation, permutation + factor.n);
  rows_.assign(rows, rows + factor.ssize);
  numbers_.assign(numbers, numbers + factor.xsize);
  int most_rows = 0;
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    Block block;
    block.first = columns[s];
    block.num_columns = columns[s + 1] - columns[s];
    block.num_rows = row_starts[s + 1] - row_starts[s];
    block.rows = rows_.data() + row_starts[s];
    block.numbers = numbers_.data() + number_starts[s];
    most_rows = std::max(most_rows, block.num_rows);
    blocks_.push_back(block);
  }
  work_.resize(static_cast<Eigen::Index>(factor.n));
  local_.resize(static_cast<std::size_t>(most_rows));
}

void RoundedFactor::solve(const Vector& b, Vector& x) {
  for (Eigen::Index k = 0; k < work_.size(); ++k) {
    work_[k] = b[permutation_[static_cast<std::size_t>(k)]];
  }
  double* const z = local_.data();
  for (const Block& block : blocks_) {
    std::copy_n(work_.data() + block.first, block.num_columns, z);
    std::fill(z + block.num_columns, z + block.num_rows, 0.0);
    substitute_forwards(block.num_columns, block.num_rows, block.numbers, z);
    std::copy_n(z, block.num_columns, work_.data() + block.first);
    for (int i = block.num_columns; i < block.num_rows; ++i) work_[block.rows[i]] += z[i];
  }
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
    for (int i = 0; i < block->num_rows; ++i) z[i] = work_[block->rows[i]];
    substitute_backwards(block->num_columns, block->num_rows, block->numbers, z);
    std::copy_n(z, block->num_columns, work_.data() + block->first);
  }
  x.resize(work_.size());
  for (Eigen::Index k = 0; k < work_.size(); ++k) {
    x[permutation_[static_cast<std::size_t>(k)]] = work_[k];
  }
}

}  // namespace elastogen
