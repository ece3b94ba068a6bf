// Colours of pictures.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace elastogen::selector {

/// Red, green, blue in [0, 1].
using Colour = std::array<double, 3>;

/// Dark blue over green to yellow, of even steps in lightness: legible in grey and to eyes that
/// do not tell red from green.
/// @param fraction  in [0, 1]
[[nodiscard]] Colour sequential_colour(double fraction);

/// `sequential_colour` as gnuplot's palette ("defined (...)").
[[nodiscard]] std::string sequential_palette();

/// Of an element's shape: prisms cyan, pyramids pink, hexahedra and
/// quadrilaterals yellow, tetrahedra and triangles blue (thesis,
/// figure 6.17).
[[nodiscard]] Colour shape_colour(std::string_view element);

/// Darker by a factor in [0, 1].
[[nodiscard]] Colour shaded(const Colour& colour, double factor);

/// 0xRRGGBB as a number, gnuplot's `rgb variable`.
[[nodiscard]] int rgb_number(const Colour& colour);

/// "#rrggbb"
[[nodiscard]] std::string rgb_text(const Colour& colour);

}  // namespace elastogen::selector
