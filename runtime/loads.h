// Dead loads as nodal force vectors.
#pragma once

#include <cstddef>
#include <span>

#include "runtime/model.h"
#include "runtime/vector.h"

namespace elastogen {

/// f += gravity as a consistent body load, f_a = integral of Lambda_a rho g over the rest shape:
/// the consistent mass of each node times g (Model::nodal_mass).
///
/// @param acceleration  [m/s^2], dim finite components
/// @throws InputError  for another number of components or one that is not finite
void add_gravity(const Model& model, std::span<const double> acceleration, VectorRef f);

/// f += a force at one node.
///
/// @param force  [N], `dim` finite components
/// @throws InputError  node outside the mesh, or a component that is not finite
void add_nodal_force(std::size_t node, std::span<const double> force, VectorRef f);

}  // namespace elastogen
