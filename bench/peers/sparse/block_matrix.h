// A sparse matrix of blocks of 3 x 3, one per pair of nodes that share an element.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace elastogen::peers {

/// Compressed rows of numbers.
struct SparseRows {
  std::vector<std::int64_t> row_begin;
  std::vector<std::int32_t> column;
  std::vector<double> value;
};

/// Sums of columns of blocks: three numbers, and where the machine has vectors of four a fourth
/// that does not count.
#ifdef __AVX__
using Column [[gnu::vector_size(4 * sizeof(double))]] = double;

inline void add_scaled(const double* numbers, double factor, Column& sum) {
  Column column;  // and the number behind it
  std::memcpy(&column, numbers, sizeof column);
  sum += column * factor;
}
#else
using Column = std::array<double, 3>;

inline void add_scaled(const double* numbers, double factor, Column& sum) {
  for (int i = 0; i < 3; ++i) sum[i] += numbers[i] * factor;
}
#endif

class BlockMatrix {
 public:
  /// @param rows  3 per node, as columns
  explicit BlockMatrix(const SparseRows& rows);

  [[nodiscard]] double bytes() const {
    return static_cast<double>(values_.size() * sizeof(double) + columns_.size() * sizeof(int));
  }

  /// result = -matrix * x
  void multiply_negative(const double* x, double* result) const;

 private:
  static constexpr std::size_t block_size = 9;

  void add_row_of_blocks(const SparseRows& rows, std::size_t node);

  std::vector<std::int64_t> block_begin_ = {0};  // of each node
  std::vector<std::int32_t> columns_;            // of each block's node
  std::vector<double> values_;                   // [block][column][row]
};

inline BlockMatrix::BlockMatrix(const SparseRows& rows) {
  const std::size_t num_nodes = (rows.row_begin.size() - 1) / 3;
  for (std::size_t node = 0; node < num_nodes; ++node) add_row_of_blocks(rows, node);
  values_.push_back(0);  // a column is loaded with the number behind it
}

inline void BlockMatrix::add_row_of_blocks(const SparseRows& rows, std::size_t node) {
  const auto begin = rows.row_begin[3 * node], end = rows.row_begin[3 * node + 3];
  std::vector<std::int32_t> nodes;
  for (auto k = begin; k < end; ++k) nodes.push_back(rows.column[k] / 3);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const std::size_t first = columns_.size();
  columns_.insert(columns_.end(), nodes.begin(), nodes.end());
  block_begin_.push_back(static_cast<std::int64_t>(columns_.size()));
  values_.resize(columns_.size() * block_size);
  for (std::size_t i = 0; i < 3; ++i) {
    for (auto k = rows.row_begin[3 * node + i]; k < rows.row_begin[3 * node + i + 1]; ++k) {
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), rows.column[k] / 3);
      const std::size_t block = first + static_cast<std::size_t>(place - nodes.begin());
      values_[block * block_size + rows.column[k] % 3 * 3 + i] = rows.value[k];
    }
  }
}

inline void BlockMatrix::multiply_negative(const double* x, double* result) const {
  for (std::size_t node = 0; node + 1 < block_begin_.size(); ++node) {
    // A sum for each column of a block: the three need not wait for each other.
    Column sum[3] = {};
    for (auto k = block_begin_[node]; k < block_begin_[node + 1]; ++k) {
      const double* block = values_.data() + k * block_size;
      const double* factor = x + 3 * columns_[k];
      for (int column = 0; column < 3; ++column) {
        add_scaled(block + 3 * column, factor[column], sum[column]);
      }
    }
    for (int i = 0; i < 3; ++i) result[3 * node + i] = -(sum[0][i] + sum[1][i] + sum[2][i]);
  }
}

}  // namespace elastogen::peers
