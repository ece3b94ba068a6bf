// Results of speed as lines of text.
#pragma once

#include <string>
#include <vector>

#include "selector/bench/speed/speed_record.h"

namespace elastogen::selector {

/// A column of the table of a benchmark's records.
struct SpeedColumn {
  std::string head;
  int width = 0;         ///< in letters, where letters are of one width
  bool is_text = false;  ///< at the left; numbers stand at the right
  std::string (*text)(const SpeedRecord&) = nullptr;
};

/// Of "kernels", "operators", "scaling" or "peers".
[[nodiscard]] const std::vector<SpeedColumn>& speed_columns(const std::string& benchmark);

/// The head of a table of records of one benchmark, and a line of it.
[[nodiscard]] std::string speed_table_head(const std::string& benchmark);
[[nodiscard]] std::string speed_table_line(const SpeedRecord& record);

/// Peaks and bandwidths, a line each.
[[nodiscard]] std::string limits_text(const MachineLimits& limits);
/// "24 KiB", "3 MiB"
[[nodiscard]] std::string size_text(std::size_t bytes);
/// "product two-stage"
[[nodiscard]] std::string operation_text(const SpeedRecord& record);

}  // namespace elastogen::selector
