#include "selector/io/colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace elastogen::selector {
namespace {

/// Even steps from dark to light.
constexpr std::array<Colour, 5> sequence = {{{0.20, 0.10, 0.40},
                                             {0.18, 0.33, 0.60},
                                             {0.13, 0.56, 0.56},
                                             {0.42, 0.76, 0.36},
                                             {0.98, 0.90, 0.25}}};

}  // namespace

Colour sequential_colour(double fraction) {
  const double at = std::clamp(fraction, 0.0, 1.0) * (sequence.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), sequence.size() - 2);
  const double t = at - static_cast<double>(below);
  Colour colour;
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = (1 - t) * sequence[below][c] + t * sequence[below + 1][c];
  }
  return colour;
}

std::string sequential_palette() {
  std::string text;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    text += fmt::format("{}{} '{}'", i == 0 ? "defined (" : ", ", i, rgb_text(sequence[i]));
  }
  return text + ")";
}

Colour shape_colour(std::string_view element) {
  if (element == "prism6") return {0.00, 0.75, 0.80};
  if (element == "pyramid5") return {0.95, 0.45, 0.70};
  if (element == "hexa8" || element == "quad4") return {0.95, 0.75, 0.05};
  if (element == "tet4" || element == "tri3") return {0.10, 0.20, 0.75};
  if (element == "hexa20") return {0.65, 0.45, 0.00};
  if (element == "tet10") return {0.45, 0.15, 0.60};
  return {0.4, 0.4, 0.4};
}

Colour shaded(const Colour& colour, double factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

int rgb_number(const Colour& colour) {
  int number = 0;
  for (const double part : colour) {
    number = number * 256 + static_cast<int>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
  }
  return number;
}

std::string rgb_text(const Colour& colour) { return fmt::format("#{:06x}", rgb_number(colour)); }

}  // namespace elastogen::selector
