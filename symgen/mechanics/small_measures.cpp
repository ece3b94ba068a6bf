#include "symgen/mechanics/small_measures.h"

#include <string>

#include "symgen/mechanics/functions.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::symbol;

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

}  // namespace

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

  const ex trace_of_strain = find_invariant("trE").symbol;
  const ex stretch = 1 + measures.volume_change;
  // |J| - J, which is exactly 0 for what is not inside out.
  const symbol mirrored = add_definition("mirrored", 2 * negative_part(stretch), definitions);
  const ex cubic = dim == 3 ? 8 * determinant(dim, strain) : ex(0);
  const symbol excess =
      add_definition("a",
                     (trace_of_strain * (measures.volume_change + mirrored) - 4 * s - cubic) /
                             (2 + measures.volume_change + mirrored) +
                         mirrored,
                     definitions);

  const auto add = [&](const symbol& deviation, const ex& slope, const ex& in_gradient,
                       const ex& in_strain) {
    measures.by_gradient.push_back({deviation, slope, in_gradient, deviation});
    measures.by_strain.push_back({deviation, slope, in_strain, deviation});
  };
  const symbol squared_strain = find_invariant("trE2").symbol;
  const symbol squared_small_strain = find_invariant("tr_eps2").symbol;
  add(find_invariant("trE").symbol, 1, q / 2, 0);
  add(squared_strain, 0, squared_strain, squared_strain);
  add(find_invariant("tr_eps").symbol, 1, 0, -q / 2);
  add(squared_small_strain, 0, squared_small_strain, squared_small_strain);
  add(measures.i1_change, 2, q, 0);
  add(measures.i2_change, 4, 2 * q + 4 * s, 4 * s);
  add(measures.volume_change, 1, k, -excess);
  return measures;
}

}  // namespace elastogen::symgen
