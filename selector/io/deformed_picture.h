// Picture of a deformed body: elements coloured by a field, every shape visible.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/mesh.h"

namespace elastogen::selector {

/// What a body is coloured by.
struct PictureColours {
  std::string title;  ///< "von Mises stress"
  std::string unit;   ///< "Pa": a prefix is put before it; empty: none
  /// For each node of each element, in the mesh's order of elements. Faces in whose nodes one is
  /// not finite are grey.
  std::vector<double> values;
  bool from_zero = true;  ///< whether colours begin at 0, if no value is below
};

/// By the displacement's magnitude.
/// @param displacement  [dim * node + component], metres
[[nodiscard]] PictureColours displacement_colours(const Mesh& mesh,
                                                  std::span<const double> displacement);

/// Draws the deformed elements near the surface, shrunk a little towards their centres (thesis,
/// figure 6.17), faces filled by the mean of their nodes' values and edged in the colour of the
/// element's shape, with colour bar, legend of the shapes, axes, and the box around the body at
/// rest. The colour bar spans the values of the elements that are drawn.
///
/// @param displacement  [dim * node + component], metres; drawn at its true scale
/// @throws WorkError  as `draw_png`
void draw_deformed(const std::filesystem::path& picture, const Mesh& mesh,
                   std::span<const double> displacement, const PictureColours& colours,
                   const std::string& title);

}  // namespace elastogen::selector
