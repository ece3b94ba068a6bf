#include "runtime/sleeping_regions.h"

#include <algorithm>
#include <cmath>

namespace elastogen {
namespace {

// Elements of a region: as many as are interleaved in batches.
constexpr std::size_t elements_per_region = 1024;

}  // namespace

template <class Scalar>
SleepingRegions::SleepingRegions(const std::vector<ElementGroup<Scalar>>& groups, int dim,
                                 double motion, int calls)
    : dim_(dim), motion_(motion), calls_(calls) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const ElementGroup<Scalar>& group = groups[g];
    if (group.at_rest) continue;
    const auto lanes = static_cast<std::size_t>(group.lanes);
    const std::size_t step = std::max<std::size_t>(1, elements_per_region / lanes);
    const std::size_t dofs_per_batch = static_cast<std::size_t>(group.num_nodes) * lanes;
    for (std::size_t begin = 0; begin < group.num_batches; begin += step) {
      Region region;
      region.batches = {g, begin, std::min(begin + step, group.num_batches)};
      region.num_elements =
          std::min(region.batches.end * lanes, group.num_elements) - begin * lanes;
      const auto at = [&](std::size_t batch) {
        return group.dofs.begin() + static_cast<std::ptrdiff_t>(batch * dofs_per_batch);
      };
      region.dofs.assign(at(begin), at(region.batches.end));
      std::sort(region.dofs.begin(), region.dofs.end());
      region.dofs.erase(std::unique(region.dofs.begin(), region.dofs.end()), region.dofs.end());
      region.place.assign(region.dofs.size() * static_cast<std::size_t>(dim), 0.0);
      regions_.push_back(std::move(region));
    }
  }
  changes_.resize(regions_.size());
}

SleepingRegions::Change SleepingRegions::follow(Region& region, const double* u) const {
  bool has_moved = false;
  for (std::size_t k = 0; k < region.dofs.size(); ++k) {
    const double* const now = u + region.dofs[k];
    const double* const then = region.place.data() + k * static_cast<std::size_t>(dim_);
    for (int i = 0; i < dim_; ++i) has_moved |= !(std::abs(now[i] - then[i]) <= motion_);
  }
  region.still_calls = has_moved ? 0 : region.still_calls + 1;
  const bool was_asleep = region.is_asleep;
  region.is_asleep = !has_moved && (was_asleep || region.still_calls >= calls_);
  const bool falls_asleep = region.is_asleep && !was_asleep;
  if (has_moved || falls_asleep) {
    for (std::size_t k = 0; k < region.dofs.size(); ++k) {
      std::copy_n(u + region.dofs[k], dim_,
                  region.place.data() + k * static_cast<std::size_t>(dim_));
    }
  }
  if (falls_asleep) return Change::fell_asleep;
  return was_asleep && !region.is_asleep ? Change::woke : Change::none;
}

void SleepingRegions::follow(const double* u, int threads) {
  const auto count = static_cast<std::ptrdiff_t>(regions_.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    const auto region = static_cast<std::size_t>(r);
    changes_[region] = follow(regions_[region], u);
  }
  has_changed_ = false;
  falling_asleep_.clear();
  num_sleeping_elements_ = 0;
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    if (changes_[r] != Change::none) has_changed_ = true;
    if (changes_[r] == Change::fell_asleep) falling_asleep_.push_back(r);
    if (regions_[r].is_asleep) num_sleeping_elements_ += regions_[r].num_elements;
  }
}

std::vector<BatchRange> SleepingRegions::awake() const {
  std::vector<BatchRange> ranges;
  for (const Region& region : regions_) {
    if (region.is_asleep) continue;
    const BatchRange& next = region.batches;
    if (!ranges.empty() && ranges.back().group == next.group && ranges.back().end == next.begin) {
      ranges.back().end = next.end;
    } else {
      ranges.push_back(next);
    }
  }
  return ranges;
}

void SleepingRegions::keep(std::size_t region, double* forces) {
  Region& r = regions_[region];
  r.forces.resize(r.place.size());
  for (std::size_t k = 0; k < r.dofs.size(); ++k) {
    double* const from = forces + r.dofs[k];
    std::copy_n(from, dim_, r.forces.data() + k * static_cast<std::size_t>(dim_));
    std::fill_n(from, dim_, 0.0);
  }
}

void SleepingRegions::add_kept(double* sum) const {
  for (const Region& region : regions_) {
    if (!region.is_asleep) continue;
    for (std::size_t k = 0; k < region.dofs.size(); ++k) {
      const double* const from = region.forces.data() + k * static_cast<std::size_t>(dim_);
      for (int i = 0; i < dim_; ++i) sum[region.dofs[k] + i] += from[i];
    }
  }
}

template SleepingRegions::SleepingRegions(const std::vector<ElementGroup<double>>&, int, double,
                                          int);
template SleepingRegions::SleepingRegions(const std::vector<ElementGroup<float>>&, int, double,
                                          int);

}  // namespace elastogen
