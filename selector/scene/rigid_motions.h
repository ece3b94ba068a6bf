// Whether constraints hold a body: statics has no answer while a rigid motion is left.
#pragma once

#include <cstddef>
#include <string>

#include "runtime/constraints.h"
#include "runtime/mesh.h"

namespace elastogen::selector {

/// A part of the mesh that can still move as a whole.
struct FreeRigidMotion {
  int count = 0;              ///< independent rigid motions that are left, 0 if all parts are held
  std::string example;        ///< "a rotation about an axis along y"
  std::size_t num_parts = 0;  ///< connected parts of the mesh
  std::size_t node = 0;       ///< some node of the part that is free
};

/// Looks at every connected part of the mesh: the six rigid motions of a part (three in the plane),
/// restricted to its constrained degrees of freedom, must be linearly independent. The first part
/// that is not held is reported.
[[nodiscard]] FreeRigidMotion find_free_rigid_motion(const Mesh& mesh,
                                                     const Constraints& constraints);

}  // namespace elastogen::selector
