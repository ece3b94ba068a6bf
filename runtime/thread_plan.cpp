#include "runtime/thread_plan.h"

#include <limits>

namespace elastogen {
namespace {

// Work of one batch in units of roughly a nanosecond: kernels loop over points and nodes.
template <class Scalar>
double batch_work(const ElementGroup<Scalar>& group) {
  return static_cast<double>(group.num_nodes) * (1 + group.table->num_points) * group.lanes;
}

template <class Scalar>
double total_work(const std::vector<ElementGroup<Scalar>>& groups,
                  const std::vector<BatchRange>& batches) {
  double total = 0;
  for (const BatchRange& range : batches) {
    total += static_cast<double>(range.end - range.begin) * batch_work(groups[range.group]);
  }
  return total;
}

template <class Scalar>
void find_node_range(const std::vector<ElementGroup<Scalar>>& groups, ThreadShare& share) {
  if (share.ranges.empty()) return;
  std::int32_t low = std::numeric_limits<std::int32_t>::max();
  std::int32_t high = -1;
  for (const BatchRange& range : share.ranges) {
    const ElementGroup<Scalar>& group = groups[range.group];
    const std::size_t per_batch = static_cast<std::size_t>(group.num_nodes * group.lanes);
    for (std::size_t k = range.begin * per_batch; k < range.end * per_batch; ++k) {
      const std::int32_t node = group.dofs[k] / group.dim;
      low = std::min(low, node);
      high = std::max(high, node);
    }
  }
  share.node_begin = low;
  share.node_end = high + 1;
}

}  // namespace

template <class Scalar>
int useful_threads(const std::vector<ElementGroup<Scalar>>& groups, int available) {
  constexpr double work_per_thread = 50000;
  const double useful = total_work(groups, moving_batches(groups)) / work_per_thread;
  return useful < available ? std::max(1, static_cast<int>(useful)) : available;
}

template <class Scalar>
std::vector<BatchRange> moving_batches(const std::vector<ElementGroup<Scalar>>& groups) {
  std::vector<BatchRange> batches;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!groups[g].at_rest) batches.push_back({g, 0, groups[g].num_batches});
  }
  return batches;
}

template <class Scalar>
std::vector<ThreadShare> plan_threads(const std::vector<ElementGroup<Scalar>>& groups,
                                      const std::vector<BatchRange>& batches, int threads) {
  const double total = total_work(groups, batches);
  std::vector<ThreadShare> shares(static_cast<std::size_t>(threads));
  double done = 0;
  std::size_t current = 0;
  for (const BatchRange& range : batches) {
    const double work = batch_work(groups[range.group]);
    std::size_t begin = range.begin;
    while (begin < range.end) {
      // The share ends with the batch that brings it to its part of the work; the last takes all.
      std::size_t end = range.end;
      if (current + 1 < shares.size()) {
        const double limit = total * static_cast<double>(current + 1) / threads;
        const double room = std::max(0.0, (limit - done) / work + 0.5);
        end = std::min(end, begin + static_cast<std::size_t>(room));
      }
      if (end > begin) shares[current].ranges.push_back({range.group, begin, end});
      done += static_cast<double>(end - begin) * work;
      begin = end;
      if (begin < range.end) ++current;
    }
  }
  for (ThreadShare& share : shares) find_node_range(groups, share);
  return shares;
}

NodeAccumulator::NodeAccumulator(const std::vector<ThreadShare>& shares, int max_values_per_node) {
  if (shares.size() == 1) return;
  for (const ThreadShare& share : shares) {
    arrays_.emplace_back(static_cast<std::size_t>(share.node_end - share.node_begin) *
                         static_cast<std::size_t>(max_values_per_node));
  }
}

void NodeAccumulator::sum(const std::vector<ThreadShare>& shares, int values_per_node,
                          double* out) const {
  const int num_shares = static_cast<int>(shares.size());
  std::int32_t num_nodes = 0;
  for (const ThreadShare& share : shares) num_nodes = std::max(num_nodes, share.node_end);
#pragma omp parallel for schedule(static, 1) num_threads(num_shares)
  for (int piece = 0; piece < num_shares; ++piece) {
    const auto piece_end = [&](int p) {
      return static_cast<std::int32_t>(static_cast<std::int64_t>(num_nodes) * p / num_shares);
    };
    for (std::size_t s = 0; s < shares.size(); ++s) {
      const std::int32_t begin = std::max(piece_end(piece), shares[s].node_begin);
      const std::int32_t end = std::min(piece_end(piece + 1), shares[s].node_end);
      if (begin >= end) continue;
      const std::ptrdiff_t per_node = values_per_node;
      const double* from = arrays_[s].data() + (begin - shares[s].node_begin) * per_node;
      double* to = out + begin * per_node;
      for (std::ptrdiff_t i = 0; i < (end - begin) * per_node; ++i) to[i] += from[i];
    }
  }
}

template int useful_threads(const std::vector<ElementGroup<double>>&, int);
template int useful_threads(const std::vector<ElementGroup<float>>&, int);
template std::vector<BatchRange> moving_batches(const std::vector<ElementGroup<double>>&);
template std::vector<BatchRange> moving_batches(const std::vector<ElementGroup<float>>&);
template std::vector<ThreadShare> plan_threads(const std::vector<ElementGroup<double>>&,
                                               const std::vector<BatchRange>&, int);
template std::vector<ThreadShare> plan_threads(const std::vector<ElementGroup<float>>&,
                                               const std::vector<BatchRange>&, int);

}  // namespace elastogen
