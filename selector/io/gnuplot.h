// Pictures by gnuplot, which needs no display.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace elastogen::selector {

/// Whether there is a gnuplot in PATH.
[[nodiscard]] bool have_gnuplot();

/// A text as gnuplot's single-quoted string, on one line.
[[nodiscard]] std::string gnuplot_quoted(std::string_view text);

/// Draws one picture, atomically.
///
/// @param picture  PNG file
/// @param width, height  pixels
/// @param script   gnuplot commands; terminal and output are set before them
/// @throws WorkError  when gnuplot is missing or fails (with what it says), or when the file cannot
///                    be written
void draw_png(const std::filesystem::path& picture, int width, int height,
              const std::string& script);

}  // namespace elastogen::selector
