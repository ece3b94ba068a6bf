// A scene as a problem for CalculiX.
#pragma once

#include <string>
#include <vector>

#include "selector/bench/calculix.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// CalculiX's elements with the nodes of one of ours: "C3D20" and "C3D20R" for "hexa20"; none for
/// a pyramid.
[[nodiscard]] std::vector<std::string> calculix_elements(const std::string& element);

/// Whether CalculiX has the law: "hooke", and "stvk" as its linear elastic material with NLGEOM.
[[nodiscard]] bool calculix_has_law(const std::string& law);

/// A static scene of one block with fixed nodes, gravity, pressures and tractions; the loads of
/// surfaces as the nodal forces that ours are.
/// @param problem       must outlive the result
/// @param element_type  one of calculix_elements
/// @param young, poisson  of its material [Pa], 1
[[nodiscard]] CalculixProblem calculix_problem(const Scene& scene, const Problem& problem,
                                               const std::string& element_type, double young,
                                               double poisson);

}  // namespace elastogen::selector
