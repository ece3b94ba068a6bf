// What the machine can do at most, measured by loops that are compiled as kernels are.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace elastogen::selector {

/// Multiply-adds on packs in registers, two flops each.
struct PeakFlops {
  bool single_precision = false;
  int threads = 1;
  double gigaflops = 0;
};

/// a[i] = b[i] + s c[i] over doubles (McCalpin's STREAM triad): 24 bytes per step, those that a
/// store reads before it writes not counted.
struct TriadBandwidth {
  std::size_t bytes = 0;  ///< of the three arrays of all threads
  int threads = 1;
  double gigabytes_per_second = 0;
};

struct MachineLimits {
  std::vector<PeakFlops> peaks;
  std::vector<TriadBandwidth> triads;  ///< for each number of threads by growing size

  /// [GFlop/s]
  [[nodiscard]] double peak(bool single_precision, int threads) const;
  /// Of the largest size up to `bytes`, or of the smallest [GB/s].
  [[nodiscard]] double bandwidth(double bytes, int threads) const;
};

/// Takes some seconds.
/// @param threads  beside one thread all of these are measured together
/// @throws WorkError  no compiler, or it failed
[[nodiscard]] MachineLimits measure_limits(int threads,
                                           const std::function<void(const std::string&)>& tell);

}  // namespace elastogen::selector
