#include "symgen/law/rest_state.h"

#include <fmt/format.h>

#include <algorithm>

#include "symgen/law/expression_text.h"
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

/// Second derivatives of the invariants at rest, [invariant][c * 9 + d], c and d entries of H.
const std::vector<std::vector<ex>>& hessians_at_rest() {
  static const std::vector<std::vector<ex>> all = [] {
    const std::vector<Definition> definitions = textbook_definitions(3);
    const std::vector<GiNaC::symbol>& gradient = displacement_gradient(3);
    GiNaC::exmap rest;
    for (const GiNaC::symbol& entry : gradient) rest[entry] = 0;
    std::vector<std::vector<ex>> result;
    for (const Invariant& invariant : invariants()) {
      const ex value = substitute_definitions(invariant.symbol, definitions);
      std::vector<ex> hessian;
      for (const GiNaC::symbol& row : gradient) {
        const ex slope = value.diff(row);
        for (const GiNaC::symbol& column : gradient) {
          hessian.push_back(slope.diff(column).subs(rest));
        }
      }
      result.push_back(std::move(hessian));
    }
    return result;
  }();
  return all;
}

GiNaC::exmap invariant_values_at_rest() {
  GiNaC::exmap rest;
  for (const InvariantAtRest& invariant : invariants_at_rest()) {
    rest[invariant.symbol] = invariant.value;
  }
  return rest;
}

constexpr const char* not_finite = "the energy or its derivative is not finite at rest (H = 0)";

}  // namespace

RestState rest_state(const ex& term) {
  const GiNaC::exmap rest = invariant_values_at_rest();
  RestState state;
  try {
    state.energy = term.subs(rest).normal();
    state.stress.assign(9, 0);
    for (const InvariantAtRest& invariant : invariants_at_rest()) {
      const ex slope = term.diff(invariant.symbol).subs(rest);
      for (std::size_t c = 0; c < 9; ++c) state.stress[c] += slope * invariant.gradient[c];
    }
    for (ex& component : state.stress) component = component.normal();
  } catch (const std::exception&) {  // GiNaC's, at a pole
    state.finite = false;
  }
  return state;
}

std::string energy_fault(const RestState& rest) {
  if (!rest.finite) return not_finite;
  if (rest.energy.is_zero()) return "";
  return fmt::format("the energy at rest (H = 0) is {}, must be 0; subtract it",
                     expression_text(rest.energy));
}

std::string stress_fault(const RestState& rest) {
  if (!rest.finite) return not_finite;
  if (std::all_of(rest.stress.begin(), rest.stress.end(),
                  [](const ex& component) { return component.is_zero(); })) {
    return "";
  }
  return fmt::format(
      "the term is not stress-free at rest: dW/dH is ({}) times the identity at H = 0, must be 0; "
      "write what only cancels together as one term, as in mu/2*(I1 - 3) - mu*log(J)",
      expression_text(rest.stress.front()));
}

std::vector<ex> rest_tangent(const ex& term) {
  const GiNaC::exmap rest = invariant_values_at_rest();
  const std::vector<InvariantAtRest>& all = invariants_at_rest();
  std::vector<ex> tangent(81, 0);
  try {
    for (std::size_t a = 0; a < all.size(); ++a) {
      const ex slope = term.diff(all[a].symbol);
      const ex slope_at_rest = slope.subs(rest);
      for (std::size_t c = 0; c < 81; ++c) tangent[c] += slope_at_rest * hessians_at_rest()[a][c];
      for (const InvariantAtRest& other : all) {
        const ex curvature = slope.diff(other.symbol).subs(rest);
        if (curvature.is_zero()) continue;
        for (std::size_t c = 0; c < 81; ++c) {
          tangent[c] += curvature * all[a].gradient[c / 9] * other.gradient[c % 9];
        }
      }
    }
    for (ex& entry : tangent) entry = entry.normal();
  } catch (const std::exception&) {  // GiNaC's, at a pole
    tangent.clear();
  }
  return tangent;
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
