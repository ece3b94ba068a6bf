// Picture of a run's history: what its probes saw over time, or over the load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elastogen::selector {

/// Curves over the same axis, drawn in one panel.
struct HistoryPanel {
  std::string label;                 ///< of the vertical axis, with its unit
  std::vector<std::size_t> columns;  ///< of the CSV file, from 0
  bool logarithmic = false;
};

/// Difference of the largest and the smallest number of each column.
/// @throws WorkError  when the file holds something else
[[nodiscard]] std::vector<double> column_ranges(const std::filesystem::path& history);

/// Draws columns of a CSV file over one of them, a panel below the other; legends name columns as
/// the file's first line does.
///
/// @param history  numbers under a line of names, separated by commas
/// @param names    those of the columns
/// @param axis     the column that the others are drawn over
/// @throws WorkError  as `draw_png`
void draw_history(const std::filesystem::path& picture, const std::filesystem::path& history,
                  const std::vector<std::string>& names, std::size_t axis,
                  const std::string& axis_label, const std::vector<HistoryPanel>& panels,
                  const std::string& title);

}  // namespace elastogen::selector
