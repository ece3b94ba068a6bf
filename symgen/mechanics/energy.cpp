#include "symgen/mechanics/energy.h"

#include "symgen/mechanics/stabilise.h"

namespace elastogen::symgen {

EnergyDensity energy_density(const Law& law, int dim, const EnergyOptions& options) {
  EnergyDensity energy;
  energy.dim = dim;
  energy.gradient = displacement_gradient(dim);
  if (!options.stabilise) {
    for (const LawTerm& term : law.terms) energy.terms.push_back(term.expression);
    energy.stabilised.assign(law.terms.size(), false);
    energy.values = energy.terms;
    energy.definitions = needed_definitions(energy.terms, textbook_definitions(dim));
    return energy;
  }
  const SmallMeasures measures = small_measures(dim);
  for (const LawTerm& term : law.terms) {
    const StabilisedTerm stable = symgen::stabilise(term, law.parameters, measures, false);
    energy.terms.push_back(stable.value);
    energy.values.push_back(
        symgen::stabilise(term, law.parameters, measures, stable.is_stable).value);
    energy.stabilised.push_back(stable.is_stable);
  }
  std::vector<GiNaC::ex> all = energy.terms;
  all.insert(all.end(), energy.values.begin(), energy.values.end());
  energy.definitions = needed_definitions(all, measures.definitions);
  return energy;
}

GiNaC::ex flatten_term(const EnergyDensity& energy, std::size_t l) {
  return substitute_definitions(energy.terms.at(l), energy.definitions);
}

}  // namespace elastogen::symgen
