#include "symgen/law/stress_form.h"

#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;

enum TensorIndex : std::size_t { unit, strain, cauchy_green, inverse, small_unit, small_strain };

/// d invariant = sum of coefficient * (tensor : dE), or d eps.
struct InvariantDerivative {
  GiNaC::symbol symbol;
  std::array<ex, num_stress_tensors> coefficients;
};

std::vector<InvariantDerivative> invariant_derivatives(const GiNaC::possymbol& j) {
  const auto symbol = [](const char* name) { return find_invariant(name).symbol; };
  std::vector<InvariantDerivative> all;
  const auto add = [&](const GiNaC::symbol& invariant) -> std::array<ex, num_stress_tensors>& {
    all.push_back({invariant, {}});
    return all.back().coefficients;
  };
  add(symbol("trE"))[unit] = 1;
  add(symbol("trE2"))[strain] = 2;
  add(symbol("I1"))[unit] = 2;
  std::array<ex, num_stress_tensors>& second = add(symbol("I2"));
  second[unit] = 2 * symbol("I1");
  second[cauchy_green] = -2;
  add(j)[inverse] = j;
  add(symbol("tr_eps"))[small_unit] = 1;
  add(symbol("tr_eps2"))[small_strain] = 2;
  return all;
}

}  // namespace

const std::array<StressTensor, num_stress_tensors>& stress_tensors() {
  static const std::array<StressTensor, num_stress_tensors> all = {
      StressTensor{"I", false},    StressTensor{"E", false}, StressTensor{"C", false},
      StressTensor{"C^-1", false}, StressTensor{"I", true},  StressTensor{"eps", true}};
  return all;
}

StressForm stress_form(const ex& term) {
  const GiNaC::possymbol j("J");
  const ex energy = resolve_powers_of_j(term, j);
  const std::vector<InvariantDerivative> derivatives = invariant_derivatives(j);
  const auto finished = [&](const ex& coefficient) {
    return coefficient.expand().subs(j == find_invariant("J").symbol);
  };
  StressForm form;
  for (std::size_t u = 0; u < num_stress_tensors; ++u) {
    ex stress = 0;
    for (const InvariantDerivative& d : derivatives) {
      stress += energy.diff(d.symbol) * d.coefficients[u];
    }
    std::vector<ex> row;
    for (std::size_t v = 0; v < num_stress_tensors; ++v) {
      ex entry = 0;
      for (const InvariantDerivative& d : derivatives) {
        entry += stress.diff(d.symbol) * d.coefficients[v];
      }
      row.push_back(finished(entry));
    }
    form.stress.push_back(finished(stress));
    form.tangent.push_back(std::move(row));
  }
  return form;
}

}  // namespace elastogen::symgen
