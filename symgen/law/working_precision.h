// How many digits GiNaC computes with.
#pragma once

#include <ginac/ginac.h>

namespace elastogen::symgen {

/// GiNaC's working precision is a global; this sets it, in decimal digits, for a scope.
class WorkingPrecision {
 public:
  explicit WorkingPrecision(long digits) : before_(GiNaC::Digits) { GiNaC::Digits = digits; }
  ~WorkingPrecision() { GiNaC::Digits = before_; }
  WorkingPrecision(const WorkingPrecision&) = delete;
  WorkingPrecision& operator=(const WorkingPrecision&) = delete;

 private:
  long before_;
};

}  // namespace elastogen::symgen
