// The greatest time step of explicit schemes.
#pragma once

#include "runtime/constraints.h"
#include "runtime/model.h"
#include "runtime/vector.h"

namespace elastogen {

/// Critical step 2 / omega [s] of central differences and of symplectic Euler about u, with the
/// greatest eigenvalue omega^2 of M^-1 K on the free degrees of freedom by power iteration, where
/// K x comes from differences of forces: kernels need no tangent. Rayleigh quotients approach
/// omega^2 from below, so a longer step than the one returned is unstable for sure, and one that
/// is shorter by some per cent is stable about u. Infinite if nothing resists (K = 0).
///
/// Source: Belytschko, Liu & Moran, Nonlinear Finite Elements for Continua and Structures,
/// section 6.6
/// @throws InputError  a bad element at u
[[nodiscard]] double critical_step(Model& model, const Constraints& constraints,
                                   const ConstVectorRef& u);

}  // namespace elastogen
