#include "symgen/law/rest_state.h"

#include <algorithm>

#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;

struct InvariantAtRest {
  GiNaC::symbol symbol;
  ex value;
  std::vector<ex> gradient;  ///< [i * 3 + j] = d/dH_ij
};

const std::vector<InvariantAtRest>& invariants_at_rest() {
  static const std::vector<InvariantAtRest> all = [] {
    const std::vector<Definition> definitions = textbook_definitions(3);
    GiNaC::exmap rest;
    for (const GiNaC::symbol& entry : displacement_gradient(3)) rest[entry] = 0;
    std::vector<InvariantAtRest> result;
    for (const Invariant& invariant : invariants()) {
      const ex value = substitute_definitions(invariant.symbol, definitions);
      InvariantAtRest at_rest{invariant.symbol, value.subs(rest), {}};
      for (const GiNaC::symbol& entry : displacement_gradient(3)) {
        at_rest.gradient.push_back(value.diff(entry).subs(rest));
      }
      result.push_back(at_rest);
    }
    return result;
  }();
  return all;
}

}  // namespace

RestState rest_state(const ex& term) {
  GiNaC::exmap rest;
  for (const InvariantAtRest& invariant : invariants_at_rest()) {
    rest[invariant.symbol] = invariant.value;
  }
  RestState state;
  state.energy = term.subs(rest).normal();
  state.stress.assign(9, 0);
  for (const InvariantAtRest& invariant : invariants_at_rest()) {
    const ex slope = term.diff(invariant.symbol).subs(rest);
    for (std::size_t c = 0; c < 9; ++c) state.stress[c] += slope * invariant.gradient[c];
  }
  for (ex& component : state.stress) component = component.normal();
  return state;
}

bool is_polynomial_in_gradient(const ex& term) {
  const GiNaC::possymbol j("J");
  const ex resolved = resolve_powers_of_j(term, j).normal();
  return resolved.is_polynomial(j) &&
         std::all_of(invariants().begin(), invariants().end(), [&](const Invariant& invariant) {
           return resolved.is_polynomial(invariant.symbol);
         });
}

}  // namespace elastogen::symgen
