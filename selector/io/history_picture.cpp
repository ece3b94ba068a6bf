#include "selector/io/history_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "runtime/error.h"
#include "selector/io/gnuplot.h"

namespace elastogen::selector {
namespace {

constexpr int panel_height = 380;

std::string plot_command(const std::string& file, const std::vector<std::string>& names,
                         std::size_t axis, const HistoryPanel& panel) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    const std::size_t column = panel.columns[i];
    command +=
        fmt::format("{}{} using {}:{} every ::1 with lines lt {} lw 2 title {}", i == 0 ? "" : ", ",
                    file, axis + 1, column + 1, i + 1, gnuplot_quoted(names[column]));
  }
  return command + "\n";
}

/// The numbers of one line.
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at < end) {
    const auto [next, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc() || (next < end && *next != ',')) return {};
    at = next + 1;
  }
  return numbers;
}

}  // namespace

std::vector<double> column_ranges(const std::filesystem::path& history) {
  std::ifstream file(history);
  std::string line;
  std::getline(file, line);  // names
  std::vector<double> low, high;
  while (std::getline(file, line)) {
    const std::vector<double> numbers = numbers_of(line);
    if (low.empty()) low = high = numbers;
    if (numbers.empty() || numbers.size() != low.size()) {
      throw WorkError(fmt::format("{}: is no table of numbers", history.string()));
    }
    for (std::size_t c = 0; c < numbers.size(); ++c) {
      low[c] = std::min(low[c], numbers[c]);
      high[c] = std::max(high[c], numbers[c]);
    }
  }
  for (std::size_t c = 0; c < low.size(); ++c) high[c] -= low[c];
  return high;
}

void draw_history(const std::filesystem::path& picture, const std::filesystem::path& history,
                  const std::vector<std::string>& names, std::size_t axis,
                  const std::string& axis_label, const std::vector<HistoryPanel>& panels,
                  const std::string& title) {
  const std::string file = gnuplot_quoted(std::filesystem::absolute(history).string());
  std::string script = fmt::format(
      "set datafile separator ','\nset grid lt 1 lw 1 lc rgb '#dddddd'\nset lmargin 12\n"
      "set rmargin 3\nset key outside top center horizontal noenhanced\nset format y '%.3g'\n"
      "set multiplot layout {},1 title {} font ',15'\n",
      panels.size(), gnuplot_quoted(title));
  for (std::size_t p = 0; p < panels.size(); ++p) {
    if (p + 1 == panels.size())
      script += fmt::format("set xlabel {}\n", gnuplot_quoted(axis_label));
    script += panels[p].logarithmic ? "set logscale y\nset format y '%.0e'\n"
                                    : "unset logscale y\nset format y '%.3g'\n";
    script += fmt::format("set ylabel {}\n", gnuplot_quoted(panels[p].label));
    script += plot_command(file, names, axis, panels[p]);
  }
  script += "unset multiplot\n";
  draw_png(picture, 1000, panel_height * static_cast<int>(panels.size()) + 60, script);
}

}  // namespace elastogen::selector
