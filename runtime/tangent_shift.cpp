#include "runtime/tangent_shift.h"

#include <algorithm>

namespace elastogen {
namespace {

constexpr double smallest = 1e-12;  // of a body a thousand times as long as thick
constexpr double largest = 1e4;     // beyond, steps are too small to be of use
constexpr double blind_growth = 100;
constexpr double growth = 4;
// In units of the lowest eigenvalue's absolute value. Measured with 1.5, 2 and 3 (decision 22).
constexpr double shift_taken = 1.5;
constexpr double shift_tolerated = 8;

}  // namespace

void TangentShift::take_next_tangent() {
  last_ = value_;
  value_ = lowest_ < 0 ? -shift_taken * lowest_ : 0;
  lowest_ = 0;
  may_refine_ = true;
}

bool TangentShift::grow() {
  if (lowest_ < 0) {
    value_ = std::max(growth * value_, -shift_taken * lowest_);
  } else {
    const double more = (last_ > 0 ? growth : blind_growth) * value_;
    value_ = std::max({smallest, more, 0.1 * last_});
  }
  return value_ <= largest;
}

void TangentShift::note(std::optional<double> lowest_curvature) {
  if (lowest_curvature) lowest_ = std::min(*lowest_curvature, 0.0);
}

bool TangentShift::refine() {
  if (!may_refine_ || !(lowest_ < 0) || value_ <= -shift_tolerated * lowest_) return false;
  may_refine_ = false;
  value_ = -shift_taken * lowest_;
  return true;
}

}  // namespace elastogen
