// Picture of a deformed body: elements coloured by displacement, every shape visible.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// Draws the deformed elements near the surface, shrunk a little towards their centres (thesis,
/// figure 6.17), faces filled by displacement magnitude and edged in the colour of the element's
/// shape, with colour bar, legend of the shapes, axes, and the box around the body at rest.
///
/// @param displacement  [3 * node + component], metres; drawn at its true scale
/// @throws WorkError  as `draw_png`
void draw_deformed(const std::filesystem::path& picture, const Mesh& mesh,
                   std::span<const double> displacement, const std::string& title);

}  // namespace elastogen::selector
