// The three files of a mixed model in X. Faure's thesis (2014), section 5.2.2.1.
#pragma once

#include <filesystem>

#include "selector/io/mesh_file.h"

namespace elastogen::selector {

/// Reads NAME.obj (nodes: lines `v x y z`), NAME.element (code 15: `nbElement N`, then for each
/// element its number of nodes and these, from 0) and NAME.info (code 16: `nbDim D`, `$ELEM`, the
/// number of elements, for each its number, Loi, Element and Decoupage, `$ENDELM`). A line that
/// starts with # is a comment; all else in the .obj file is left out, with a note.
///
/// All elements are of the region `default`. Names become ours: Hooke and SaintVenant; Triangle,
/// Quad, Tetra, Hexa or Cube, Prism, Pyramid, with a number of nodes and Gauss points as in Cube8I;
/// DecoupageNon, DecoupageTout (all four), or Decoupage with some of the letters L, G, N, D.
///
/// @throws InputError  a file that is missing, or a line that does not fit, by its number
[[nodiscard]] MeshFile read_thesis_mesh(const std::filesystem::path& obj_file);

/// Our association for the thesis's three names: "stvk-hexa8-q8-g" for SaintVenant, Cube8I,
/// DecoupageG. A name without a number of Gauss points takes the usual quadrature of the element.
/// @throws InputError  for a name that is none of those above
[[nodiscard]] std::string association_of_led(const std::string& law, const std::string& element,
                                             const std::string& split);

}  // namespace elastogen::selector
