// Which thread computes which batches, and how their results are summed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/aligned_vector.h"
#include "runtime/element_group.h"

namespace elastogen {

/// Consecutive batches of one group.
struct BatchRange {
  std::size_t group = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// What one thread computes: about as much work as every other.
struct ThreadShare {
  std::vector<BatchRange> ranges;
  std::int32_t node_begin = 0;  ///< nodes of its elements lie in [node_begin, node_end)
  std::int32_t node_end = 0;
};

/// Number of threads that pays for these groups, at most `available`: a thread that computes for
/// less than about 50 microseconds costs more than it brings.
template <class Scalar>
[[nodiscard]] int useful_threads(const std::vector<ElementGroup<Scalar>>& groups, int available);

/// All batches of the groups that are not at rest.
template <class Scalar>
[[nodiscard]] std::vector<BatchRange> moving_batches(
    const std::vector<ElementGroup<Scalar>>& groups);

/// One share per thread. The shares follow the order of `batches`, so with natural node numbers the
/// node ranges of two shares overlap little.
template <class Scalar>
[[nodiscard]] std::vector<ThreadShare> plan_threads(const std::vector<ElementGroup<Scalar>>& groups,
                                                    const std::vector<BatchRange>& batches,
                                                    int threads);

/// Sums what the shares compute into node-major arrays. Every share writes to an array of its own
/// over its node range; these are then added share by share, so that the sum depends on the plan
/// only and never on timing.
class NodeAccumulator {
 public:
  /// @param max_values_per_node  largest `values_per_node` that run() will be called with
  NodeAccumulator(const std::vector<ThreadShare>& shares, int max_values_per_node);

  /// Calls `compute(share number, node_begin, array)` for each share, in parallel. The array holds
  /// values_per_node numbers for each node from node_begin on, to be added to; then
  /// out[node * values_per_node + i] += the sum of the arrays.
  template <class Compute>
  void run(const std::vector<ThreadShare>& shares, int values_per_node, double* out,
           Compute&& compute) {
    const int num_shares = static_cast<int>(shares.size());
    if (num_shares == 1) {
      compute(0, 0, out);
      return;
    }
#pragma omp parallel for schedule(static, 1) num_threads(num_shares)
    for (int s = 0; s < num_shares; ++s) {
      const ThreadShare& share = shares[static_cast<std::size_t>(s)];
      AlignedVector<double>& array = arrays_[static_cast<std::size_t>(s)];
      const std::size_t length = static_cast<std::size_t>(share.node_end - share.node_begin) *
                                 static_cast<std::size_t>(values_per_node);
      std::fill_n(array.data(), length, 0.0);
      compute(s, share.node_begin, array.data());
    }
    sum(shares, values_per_node, out);
  }

 private:
  void sum(const std::vector<ThreadShare>& shares, int values_per_node, double* out) const;

  std::vector<AlignedVector<double>> arrays_;  // [share]; none for a single share
};

}  // namespace elastogen
