// Results of speed beside those of another time.
#pragma once

#include <string>

#include "selector/bench/speed/speed_record.h"

namespace elastogen::selector {

/// What changed between two results beyond noise: a record's noise is how far its median lies above
/// its minimum, at least 2 %; a change is one of the minima that is greater than that of both.
[[nodiscard]] std::string compare_speed(const SpeedResults& before, const SpeedResults& after);

}  // namespace elastogen::selector
