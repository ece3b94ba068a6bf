#include "symgen/mechanics/energy.h"

#include <algorithm>

#include "runtime/error.h"
#include "symgen/mechanics/functions.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::symbol;

/// Something in a law's term that vanishes at rest: the invariant less its rest value, or log J.
///   deviation = slope * t + remainder,  t = tr H of first order, remainder of second order.
struct Deviation {
  symbol deviation;
  ex slope;      ///< a number; 0 for what is of second order itself
  ex remainder;  ///< over the definitions and `log_remainder` below
};

/// The measures of deformation near rest.
struct SmallMeasures {
  std::vector<Definition> definitions;
  symbol volume_change;  ///< j = J - 1 = t + k
  symbol i1_change;      ///< I1 - 3
  symbol i2_change;      ///< I2 - 3
  symbol logarithm = symbol("log_J");
  std::vector<Deviation> deviations;
};

symbol add_definition(const std::string& name, const ex& value,
                      std::vector<Definition>& definitions) {
  definitions.push_back({symbol(name), value});
  return definitions.back().symbol;
}

/// Sum of the principal 2 x 2 minors of m[i * dim + j].
ex principal_minors(int dim, const std::vector<ex>& m) {
  const auto entry = [&](int i, int j) { return m[static_cast<std::size_t>(i * dim + j)]; };
  ex sum = 0;
  for (int i = 0; i < dim; ++i) {
    for (int j = i + 1; j < dim; ++j) sum += entry(i, i) * entry(j, j) - entry(i, j) * entry(j, i);
  }
  return sum;
}

/// With t = tr H, q = |H|^2, k = minors(H) + det H and s = minors(E), E the Green-Lagrange strain:
///   tr E = t + q/2,  J - 1 = t + k,  I1 - 3 = 2 t + q,  I2 - 3 = 4 t + 2 q + 4 s,
///   log J = t + k - log1p_remainder(t + k).
SmallMeasures small_measures(int dim) {
  SmallMeasures measures;
  std::vector<Definition>& definitions = measures.definitions;
  const std::vector<ex> strain = define_green_lagrange(dim, definitions);
  define_strain_invariants(dim, strain, definitions);

  const std::vector<symbol>& gradient = displacement_gradient(dim);
  const std::vector<ex> h(gradient.begin(), gradient.end());
  ex trace = 0, square = 0;
  for (int i = 0; i < dim; ++i) trace += h[static_cast<std::size_t>(i * dim + i)];
  for (const ex& entry : h) square += GiNaC::pow(entry, 2);
  const symbol t = add_definition("t", trace, definitions);
  const symbol q = add_definition("q", square, definitions);
  // In two dimensions the determinant is the only principal minor.
  const ex higher = principal_minors(dim, h) + (dim == 3 ? determinant(dim, h) : ex(0));
  const symbol k = add_definition("k", higher, definitions);
  const symbol s = add_definition("s", principal_minors(dim, strain), definitions);
  measures.volume_change = add_definition("j", t + k, definitions);
  measures.i1_change = add_definition("dI1", 2 * t + q, definitions);
  measures.i2_change = add_definition("dI2", 4 * t + 2 * q + 4 * s, definitions);

  const symbol squared_strain = find_invariant("trE2").symbol;
  const symbol squared_small_strain = find_invariant("tr_eps2").symbol;
  measures.deviations = {{find_invariant("trE").symbol, 1, q / 2},
                         {squared_strain, 0, squared_strain},
                         {find_invariant("tr_eps").symbol, 1, 0},
                         {squared_small_strain, 0, squared_small_strain},
                         {measures.i1_change, 2, q},
                         {measures.i2_change, 4, 2 * q + 4 * s},
                         {measures.volume_change, 1, k},
                         {measures.logarithm, 1, k - log1p_remainder(measures.volume_change)}};
  return measures;
}

/// The law's term over deviations instead of invariants.
ex in_deviations(const ex& term, const SmallMeasures& measures) {
  const GiNaC::possymbol j("J");
  const ex resolved = resolve_powers_of_j(term, j).subs(GiNaC::log(j) == measures.logarithm);
  const GiNaC::exmap changes = {{j, 1 + measures.volume_change},
                                {find_invariant("I1").symbol, 3 + measures.i1_change},
                                {find_invariant("I2").symbol, 3 + measures.i2_change}};
  return resolved.subs(changes);
}

ex with_log1p(const ex& expression, const SmallMeasures& measures) {
  return expression.subs(measures.logarithm == log1p(measures.volume_change));
}

/// A polynomial of low enough degree to be expanded: (1 + j)^n loses digits under compression,
/// where its terms alternate (four of them at n = 20 and J = 0.3).
bool is_polynomial_in_deviations(const ex& expression, const SmallMeasures& measures) {
  constexpr int highest_degree = 8;
  return std::all_of(measures.deviations.begin(), measures.deviations.end(),
                     [&](const Deviation& entry) {
                       return expression.is_polynomial(entry.deviation) &&
                              expression.degree(entry.deviation) <= highest_degree;
                     });
}

/// Takes out the powers of parameters that all summands share. (GiNaC's own gcd leaves a numeric
/// factor whose sign depends on the order of symbols, hence on the run.)
ex take_out_parameters(const ex& sum, const std::vector<Parameter>& parameters) {
  if (!GiNaC::is_a<GiNaC::add>(sum)) return sum;
  ex factor = 1;
  for (const Parameter& parameter : parameters) {
    if (!sum.is_polynomial(parameter.symbol)) continue;
    int power = sum.op(0).ldegree(parameter.symbol);
    for (const ex& summand : sum) power = std::min(power, summand.ldegree(parameter.symbol));
    factor *= GiNaC::pow(parameter.symbol, power);
  }
  return factor * (sum / factor).expand();
}

/// A polynomial in deviations, first-order parts cancelled. A deviation that stands alone, times
/// something of order zero, is replaced by slope * t + remainder; the t must add up to nothing.
/// All other monomials are of second order in small numbers that are known to rounding.
ex cancel_first_order(const ex& polynomial, const SmallMeasures& measures, const LawTerm& term,
                      const std::vector<Parameter>& parameters) {
  GiNaC::exmap at_rest;
  for (const Deviation& entry : measures.deviations) at_rest[entry.deviation] = 0;
  const ex expanded = polynomial.expand();
  ex rewritten = expanded;
  ex first_order = 0;
  for (const Deviation& entry : measures.deviations) {
    const ex coefficient = expanded.coeff(entry.deviation, 1).subs(at_rest);
    first_order += coefficient * entry.slope;
    rewritten += coefficient * (entry.remainder - entry.deviation);
  }
  if (!first_order.normal().is_zero() || !expanded.subs(at_rest).normal().is_zero()) {
    throw InternalError("term '" + term.name + "' is not stress-free at rest");
  }
  return take_out_parameters(with_log1p(rewritten.expand(), measures), parameters);
}

}  // namespace

EnergyDensity energy_density(const Law& law, int dim, const EnergyOptions& options) {
  EnergyDensity energy;
  energy.dim = dim;
  energy.gradient = displacement_gradient(dim);
  if (!options.stabilise) {
    for (const LawTerm& term : law.terms) energy.terms.push_back(term.expression);
    energy.stabilised.assign(law.terms.size(), false);
    energy.definitions = needed_definitions(energy.terms, textbook_definitions(dim));
    return energy;
  }
  const SmallMeasures measures = small_measures(dim);
  for (const LawTerm& term : law.terms) {
    const ex expression = in_deviations(term.expression, measures);
    const bool is_recognised = is_polynomial_in_deviations(expression, measures);
    energy.terms.push_back(is_recognised
                               ? cancel_first_order(expression, measures, term, law.parameters)
                               : with_log1p(expression, measures));
    energy.stabilised.push_back(is_recognised);
  }
  energy.definitions = needed_definitions(energy.terms, measures.definitions);
  return energy;
}

GiNaC::ex flatten_term(const EnergyDensity& energy, std::size_t l) {
  return substitute_definitions(energy.terms.at(l), energy.definitions);
}

}  // namespace elastogen::symgen
