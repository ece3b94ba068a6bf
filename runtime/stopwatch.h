// Wall-clock time of a scope, added to a total.
#pragma once

#include <chrono>

namespace elastogen {

class Stopwatch {
 public:
  /// @param total  [s]; receives the time between construction and destruction
  explicit Stopwatch(double& total) : total_(total), start_(Clock::now()) {}
  ~Stopwatch() { total_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& total_;
  Clock::time_point start_;
};

}  // namespace elastogen
