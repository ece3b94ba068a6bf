#include "selector/io/gnuplot.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "runtime/error.h"
#include "selector/io/atomic_file.h"
#include "selector/support/process.h"

namespace elastogen::selector {

bool have_gnuplot() { return find_program("gnuplot").has_value(); }

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "'";
}

void draw_png(const std::filesystem::path& picture, int width, int height,
              const std::string& script) {
  write_atomically(picture, [&](const std::filesystem::path& temporary) {
    std::filesystem::path commands = temporary;
    commands.replace_extension(".gnuplot");
    std::ofstream file(commands);
    file << fmt::format(
        "set encoding utf8\n"
        "set terminal pngcairo noenhanced size {},{} font 'sans,13' background '#ffffff'\n"
        "set output {}\n{}\nunset output\n",
        width, height, gnuplot_quoted(temporary.string()), script);
    file.close();
    const bool written = !file.fail();
    const ProcessResult result =
        written ? run_process({"gnuplot", commands.string()}) : ProcessResult{};
    std::error_code error;
    std::filesystem::remove(commands, error);
    if (!written || result.exit_status != 0 || result.signal != 0 ||
        !std::filesystem::exists(temporary)) {
      throw WorkError(fmt::format("{}: the picture cannot be drawn: {}", picture.string(),
                                  written ? "gnuplot says: " + result.output
                                          : "its gnuplot commands cannot be written beside it"));
    }
  });
}

}  // namespace elastogen::selector
