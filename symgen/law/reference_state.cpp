#include "symgen/law/reference_state.h"

#include <array>

#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::matrix;
using GiNaC::numeric;

/// Values of all invariants, with the parameters'.
GiNaC::exmap values_at(const matrix& gradient, const GiNaC::exmap& parameters) {
  GiNaC::exmap values = parameters;
  for (unsigned c = 0; c < 9; ++c) {
    values[displacement_gradient(3)[c]] = gradient(c / 3, c % 3);
  }
  for (const Definition& definition : textbook_definitions(3)) {
    values[definition.symbol] = definition.value.subs(values);
  }
  return values;
}

std::optional<numeric> real_value(const ex& expression, const GiNaC::exmap& values) {
  try {
    const ex value = expression.subs(values).evalf();
    if (GiNaC::is_a<numeric>(value) && GiNaC::ex_to<numeric>(value).is_real()) {
      return GiNaC::ex_to<numeric>(value);
    }
  } catch (const std::exception&) {  // GiNaC's, at a pole
  }
  return std::nullopt;
}

numeric contraction(const matrix& a, const matrix& b) {
  ex sum = 0;
  for (unsigned c = 0; c < 9; ++c) sum += a(c / 3, c % 3) * b(c / 3, c % 3);
  return GiNaC::ex_to<numeric>(sum);
}

matrix identity() { return GiNaC::ex_to<matrix>(GiNaC::unit_matrix(3)); }

}  // namespace

std::optional<numeric> reference_energy(const ex& term, const matrix& gradient,
                                        const GiNaC::exmap& parameters) {
  return real_value(term, values_at(gradient, parameters));
}

std::optional<ReferenceState> reference_state(const ex& term, const StressForm& form,
                                              const matrix& gradient, const matrix& direction,
                                              const GiNaC::exmap& parameters) {
  const GiNaC::exmap values = values_at(gradient, parameters);
  const std::optional<numeric> energy = real_value(term, values);
  if (!energy) return std::nullopt;

  const ex half = numeric(1, 2);
  const matrix one = identity(), zero(3, 3);
  const matrix f = one.add(gradient), c = f.transpose().mul(f), c_inverse = c.inverse();
  const matrix strain = c.sub(one).mul_scalar(half);
  const matrix small = gradient.add(gradient.transpose()).mul_scalar(half);
  const matrix d_small = direction.add(direction.transpose()).mul_scalar(half);
  const matrix f_dh = f.transpose().mul(direction);
  const matrix d_strain = f_dh.add(f_dh.transpose()).mul_scalar(half);
  const std::array<matrix, num_stress_tensors> tensors = {one, strain, c, c_inverse, one, small};
  const std::array<matrix, num_stress_tensors> changes = {
      zero, d_strain, d_strain.mul_scalar(2), c_inverse.mul(d_strain).mul(c_inverse).mul_scalar(-2),
      zero, d_small};

  // [0]: S, [1]: sigma
  std::array<matrix, 2> stress = {zero, zero}, change = {zero, zero};
  for (std::size_t u = 0; u < num_stress_tensors; ++u) {
    const std::size_t kind = stress_tensors()[u].small_strain ? 1 : 0;
    const std::optional<numeric> coefficient = real_value(form.stress[u], values);
    if (!coefficient) return std::nullopt;
    stress[kind] = stress[kind].add(tensors[u].mul_scalar(*coefficient));
    change[kind] = change[kind].add(changes[u].mul_scalar(*coefficient));
    for (std::size_t v = 0; v < num_stress_tensors; ++v) {
      const std::optional<numeric> entry = real_value(form.tangent[u][v], values);
      if (!entry) return std::nullopt;
      const numeric along =
          contraction(tensors[v], stress_tensors()[v].small_strain ? d_small : d_strain);
      change[kind] = change[kind].add(tensors[u].mul_scalar(*entry * along));
    }
  }
  return ReferenceState{*energy, f.mul(stress[0]).add(stress[1]),
                        direction.mul(stress[0]).add(f.mul(change[0])).add(change[1])};
}

}  // namespace elastogen::symgen
