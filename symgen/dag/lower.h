// From GiNaC to the graph.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// What the symbols of a GiNaC expression stand for.
using SymbolNodes = std::map<GiNaC::ex, NodeId, GiNaC::ex_is_less>;

/// The graph of a GiNaC expression: rationals, square roots of rationals, symbols in `symbols`,
/// sums, products, powers with rational exponents, log, log1p, log1p_remainder, exp. GiNaC orders
/// its operands differently from run to run; ours are ordered by their text, so equal input gives
/// an equal graph.
/// @throws InternalError  for anything else
[[nodiscard]] NodeId lower(Dag& dag, const GiNaC::ex& expression, const SymbolNodes& symbols);

/// Several expressions; what they have in common is walked once.
[[nodiscard]] std::vector<NodeId> lower(Dag& dag, const std::vector<GiNaC::ex>& expressions,
                                        const SymbolNodes& symbols);

/// The exact value of an expression in which every symbol has one.
[[nodiscard]] ExactNumber exact_value(
    const GiNaC::ex& expression, const std::map<GiNaC::ex, ExactNumber, GiNaC::ex_is_less>& values);

}  // namespace elastogen::symgen
