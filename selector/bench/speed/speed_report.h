// Results of speed to look at.
#pragma once

#include <string>

#include "selector/bench/speed/speed_record.h"

namespace elastogen::selector {

/// Peaks and bandwidths, a line each.
[[nodiscard]] std::string limits_text(const MachineLimits& limits);

/// The head of a table of records of one benchmark, and a line of it.
[[nodiscard]] std::string speed_table_head(const std::string& benchmark);
[[nodiscard]] std::string speed_table_line(const SpeedRecord& record);

/// A page with rooflines (Williams, Waterman & Patterson, CACM 52 (2009) 65-76) and all records.
[[nodiscard]] std::string speed_html(const SpeedResults& results);

/// What changed between two results beyond noise: a record's noise is how far its median lies above
/// its minimum, at least 2 %; a change is one of the minima that is greater than that of both.
[[nodiscard]] std::string compare_speed(const SpeedResults& before, const SpeedResults& after);

}  // namespace elastogen::selector
