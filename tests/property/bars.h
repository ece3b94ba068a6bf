// Bars of shipped laws with linked kernels, ready to be solved.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/model.h"

namespace elastogen::test {

/// A bar along x from the origin, cut into sections of equal length.
[[nodiscard]] Mesh make_bar_mesh(const std::array<double, 3>& size, const std::array<int, 3>& cells,
                                 const std::vector<std::string>& associations);

/// One part per block of the mesh, in the order of `associations`.
[[nodiscard]] std::vector<ModelPart> parts_of(const Mesh& mesh,
                                              const std::vector<std::string>& associations,
                                              double young, double poisson, double density);

}  // namespace elastogen::test
