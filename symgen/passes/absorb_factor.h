// A number that multiplies every result, taken into a stored constant.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// Which constant is stored `factor` times as large, for results that need the factor no more.
struct AbsorbedFactor {
  std::size_t constant;  ///< index into the constants
  NumberId factor;
};

/// Weights of quadrature end up in front of results, where each costs a multiplication: those of a
/// tetrahedron are all 1/6 of something. If everything computed is proportional to one constant
/// (its volume), that may hold the factor.
///
/// @param nodal      results, all the same positive multiple of other values but for their sign
/// @param energies   other results that are proportional to the constant
/// @param margins    values that must not depend on it
/// @param constants  what is stored; nodes below them are not looked at
[[nodiscard]] std::optional<AbsorbedFactor> absorb_factor(const Dag& dag,
                                                          std::span<const NodeId> nodal,
                                                          std::span<const NodeId> energies,
                                                          std::span<const NodeId> margins,
                                                          const std::vector<NodeId>& constants);

}  // namespace elastogen::symgen
