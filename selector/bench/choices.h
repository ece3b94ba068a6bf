// Choices of the benchmark's problems, by element.
#pragma once

#include <string>
#include <vector>

#include "selector/bench/work_precision_problem.h"

namespace elastogen::selector {

/// Meshes of a problem, from coarse to fine.
struct MeshFamilies {
  std::vector<std::vector<int>> linear;     ///< of tet4, prism6, pyramid5, hexa8
  std::vector<std::vector<int>> quadratic;  ///< of tet10, hexa20
};

/// Every selected three-dimensional element and quadrature with every mesh of its family, in the
/// order of elements.
/// @param own_laws  where the selection names none
/// @param solvers   all of them for each mesh; of a quick selection the first
[[nodiscard]] std::vector<WorkPrecisionChoice> all_choices(
    const WorkPrecisionSelection& selection, const std::vector<std::string>& own_laws,
    const MeshFamilies& meshes, const std::vector<SolverChoice>& solvers);

}  // namespace elastogen::selector
