// How elements look in the report's charts.
#pragma once

#include <string>
#include <string_view>

namespace elastogen::selector {

/// Our element of the same nodes as one of CalculiX ("hexa20" for "C3D20R"); others as they are.
[[nodiscard]] std::string_view element_like(std::string_view element);

/// "#rrggbb": hues as in the thesis's figure 6.17 and our pictures (tetrahedra blue, hexahedra
/// yellow to orange, prisms cyan, pyramids pink), here in tones that stand out from white; the
/// quadratic elements in the darker tone of their hue.
/// @param element  ours or CalculiX's
[[nodiscard]] std::string element_colour(std::string_view element);

}  // namespace elastogen::selector
