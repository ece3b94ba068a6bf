// Displacements of a result file: as they are, and at any point of its body at rest.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace elastogen::selector {

/// Of the nodes of a body, [3 * node + component], metres.
struct ResultField {
  std::vector<double> positions;  ///< at rest
  std::vector<double> displacements;
};

/// The points of a .vtu file with their data "displacement", as `write_vtu` writes them.
/// @throws InputError  a file that is missing, no VTU or without displacements
[[nodiscard]] ResultField read_result_field(const std::filesystem::path& file);

/// The point data "displacement" of a .vtu file as `write_vtu` writes them, at points of the body
/// at rest: in each cell by its linear shape functions, as VTK has them (of pyramids not exactly
/// ours, but for their nodes).
///
/// @param positions  [dim * point + component], metres
/// @param dim        2: the file's third coordinate is 0
/// @return           [dim * point + component], metres
/// @throws InputError  a file that is missing, no VTU or without displacements; a point that lies
/// in
///                     none of its cells
[[nodiscard]] std::vector<double> displacements_at(const std::filesystem::path& file,
                                                   std::span<const double> positions, int dim);

/// How far displacements are from those of a reference, over all nodes [m].
struct FieldDistance {
  double mean = 0, minimum = 0, maximum = 0;  ///< of |u - reference|, as in thesis table 6.7
};

/// @param values, reference  [dim * node + component], metres
[[nodiscard]] FieldDistance field_distance(std::span<const double> values,
                                           std::span<const double> reference, int dim);

}  // namespace elastogen::selector
