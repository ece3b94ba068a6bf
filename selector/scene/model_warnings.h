// What is likely wrong with a model though it can be computed.
#pragma once

#include <string>
#include <vector>

#include "runtime/stress.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// Known before anything is solved: linear elements of a nearly incompressible law (nu > 0.49 at
/// rest), which lock; parameters for which a law is unstable, at rest or, where they are measured
/// ones and do not follow from E and nu, at usual stretches. One warning for each material and
/// kind.
[[nodiscard]] std::vector<std::string> material_warnings(const Problem& problem);

/// Known at the end: elements turned inside out (det(I + H) <= 0 at a point), and strains beyond 5
/// % or rotations beyond 5 degrees in laws that declare small_strain; of U and R in I + H = R U.
/// One warning for each kind and law, with the number of elements and the worst by the file's
/// number.
///
/// @param field  of all points of the problem's mesh
[[nodiscard]] std::vector<std::string> deformation_warnings(const Problem& problem,
                                                            const StressField& field);

}  // namespace elastogen::selector
