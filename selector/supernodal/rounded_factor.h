// A supernodal factor in single precision.
#pragma once

#include <cholmod.h>

#include <vector>

#include "runtime/vector.h"

namespace elastogen {

/// Substitution with a factor whose numbers are kept as floats: it reads half as much memory, which
/// is what substitution waits for. Sums are in double.
class RoundedFactor {
 public:
  /// @param factor  supernodal, with 32-bit indices; nothing of it is kept
  explicit RoundedFactor(const cholmod_factor& factor);

  /// x = about (P^T L L^T P)^-1 b
  void solve(const Vector& b, Vector& x);

 private:
  /// Dense columns [first, first + num_columns) with the rows from `rows` on, of which the first
  /// num_columns are the columns' own.
  struct Block {
    int first = 0;
    int num_columns = 0;
    int num_rows = 0;
    const int* rows = nullptr;
    const float* numbers = nullptr;  // column after column
  };

  std::vector<int> permutation_;
  std::vector<int> rows_;
  std::vector<float> numbers_;
  std::vector<Block> blocks_;
  Vector work_;
  std::vector<double> local_;
};

}  // namespace elastogen
