// Symbolic proof that a reference element is what it must be.
#pragma once

#include <string>
#include <vector>

#include "symgen/element/element.h"

namespace elastogen::symgen {

/// Checks, exactly: partition of unity (the functions sum to 1), the Kronecker property at the
/// nodes, linear completeness (sum of Lambda_a X_a is the coordinate itself), and a positive
/// Jacobian of the reference shape mapped onto itself. Function values at a node are the limits
/// along the last coordinate, which gives the apex of a rational pyramid its value.
///
/// @return what is violated, a sentence each ("Lambda_2 is 1 at node 3, must be 0"); empty: sound
[[nodiscard]] std::vector<std::string> check_element(const Element& element);

}  // namespace elastogen::symgen
