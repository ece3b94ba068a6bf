// Picture of a deflection curve beside its reference.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "selector/io/deflection_curve.h"

namespace elastogen::selector {

/// A reference curve with the name it has in the legend.
struct NamedCurve {
  std::string label;
  DeflectionCurve curve;
};

/// Draws the deflection over x; with a reference, also what is between the two, below, in
/// millimetres.
/// @throws WorkError  as `draw_png`
void draw_curve(const std::filesystem::path& picture, const DeflectionCurve& curve,
                const std::optional<NamedCurve>& reference, const std::string& title);

}  // namespace elastogen::selector
