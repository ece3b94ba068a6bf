// Times of short calls on machines that do other work, too.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace elastogen::selector {

/// Of one call, over all samples [s].
struct Timing {
  double minimum = 0;
  double median = 0;

  [[nodiscard]] Timing operator/(double count) const { return {minimum / count, median / count}; }
};

/// Processor time of the calling thread, or time of day where several threads work [s].
inline double clock_seconds(bool of_thread) {
  std::timespec now{};
  clock_gettime(of_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Calls `function` again and again. A sample lasts about 2 ms or one call, less than a scheduler's
/// slice: the best ones are undisturbed. The first call is not counted.
/// @param threads  that the function works in
/// @param seconds  for all samples; there are at least five
template <class Function>
[[nodiscard]] Timing time_calls(int threads, double seconds, Function&& function) {
  constexpr double sample_seconds = 2e-3;
  constexpr std::size_t least_samples = 5;
  const bool of_thread = threads == 1;
  function();
  const double first = clock_seconds(of_thread);
  function();
  const double once = std::max(clock_seconds(of_thread) - first, 1e-9);
  const long calls = std::max(1L, static_cast<long>(sample_seconds / once));
  std::vector<double> samples;
  const double begin = clock_seconds(false);
  while (samples.size() < least_samples || clock_seconds(false) - begin < seconds) {
    const double start = clock_seconds(of_thread);
    for (long k = 0; k < calls; ++k) function();
    samples.push_back((clock_seconds(of_thread) - start) / static_cast<double>(calls));
  }
  std::sort(samples.begin(), samples.end());
  return {samples.front(), samples[samples.size() / 2]};
}

}  // namespace elastogen::selector
