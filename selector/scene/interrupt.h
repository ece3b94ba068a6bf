// Ctrl-C as a question that long work asks, not as sudden death.
#pragma once

#include <csignal>

namespace elastogen::selector {

/// While an object lives, SIGINT is noted instead of ending the program; a second one ends it.
/// One object at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] bool interrupted() const;

 private:
  struct sigaction before_ {};
};

}  // namespace elastogen::selector
