// Results of speed as a page.
#pragma once

#include <string>

#include "selector/bench/speed/speed_record.h"

namespace elastogen::selector {

/// A page with rooflines (Williams, Waterman & Patterson, CACM 52 (2009) 65-76) and all records.
[[nodiscard]] std::string speed_html(const SpeedResults& results);

}  // namespace elastogen::selector
