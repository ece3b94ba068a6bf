#include "symgen/law/stability.h"

#include <array>
#include <cmath>

#include "symgen/law/moduli.h"
#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

GiNaC::exmap values_of(const Law& law, const std::vector<double>& parameters) {
  GiNaC::exmap values;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    values[law.parameters[p].symbol] = numeric(parameters[p]);
  }
  return values;
}

std::optional<double> value_of(const ex& expression, const GiNaC::exmap& values) {
  try {
    const ex value = expression.subs(values).evalf();
    if (GiNaC::is_a<numeric>(value) && GiNaC::ex_to<numeric>(value).is_real()) {
      return GiNaC::ex_to<numeric>(value).to_double();
    }
  } catch (const std::exception&) {  // GiNaC's, at a pole
  }
  return std::nullopt;
}

/// Energy over two logarithmic principal strains; the third keeps the volume.
class IsochoricEnergy {
 public:
  IsochoricEnergy(const Law& law, const std::vector<double>& parameters) {
    const ex third = -first_ - second_;
    ex trace = 0, trace_of_square = 0;  // of C
    for (const ex& strain : {ex(first_), ex(second_), third}) {
      trace += GiNaC::exp(2 * strain);
      trace_of_square += GiNaC::exp(4 * strain);
    }
    GiNaC::exmap values = values_of(law, parameters);
    const auto set = [&](const char* invariant, const ex& value) {
      values[find_invariant(invariant).symbol] = value;
    };
    set("trE", (trace - 3) / 2);
    set("trE2", (trace_of_square - 2 * trace + 3) / 4);
    set("I1", trace);
    set("I2", (trace * trace - trace_of_square) / 2);
    set("I3", 1);
    set("J", 1);
    for (const LawTerm& term : law.terms) energy_ += term.expression.subs(values);
    second_derivatives_ = {energy_.diff(first_, 2), energy_.diff(first_).diff(second_),
                           energy_.diff(second_, 2)};
  }

  /// Whether the second derivatives are positive definite; nothing outside the law's domain.
  [[nodiscard]] std::optional<bool> is_convex(double first, double second) const {
    const GiNaC::exmap strains = {{first_, numeric(first)}, {second_, numeric(second)}};
    // Derivatives of a logarithm are real where it is not.
    if (!value_of(energy_, strains)) return std::nullopt;
    std::array<double, 3> values{};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::optional<double> value = value_of(second_derivatives_[k], strains);
      if (!value) return std::nullopt;
      values[k] = *value;
    }
    return values[0] > 0 && values[0] * values[2] > values[1] * values[1];
  }

 private:
  GiNaC::symbol first_ = GiNaC::symbol("first"), second_ = GiNaC::symbol("second");
  ex energy_ = 0;
  std::array<ex, 3> second_derivatives_;
};

struct Mode {
  const char* name;
  double second;    ///< logarithmic strain across, as a part of that along
  double furthest;  ///< stretch
};

constexpr std::array<Mode, 4> modes = {Mode{"uniaxial tension", -0.5, 2},
                                       {"uniaxial compression", -0.5, 0.5},
                                       {"equibiaxial tension", 1, 2},
                                       {"pure shear", 0, 2}};

/// The logarithmic strain, as a part of the furthest, where stability is lost.
std::optional<double> find_loss(const IsochoricEnergy& energy, const Mode& mode) {
  constexpr int num_steps = 20, num_halvings = 6;
  const double furthest = std::log(mode.furthest);
  const auto is_stable = [&](double part) {
    return energy.is_convex(part * furthest, part * furthest * mode.second);
  };
  for (int step = 1; step <= num_steps; ++step) {
    double unstable = static_cast<double>(step) / num_steps;
    const std::optional<bool> found = is_stable(unstable);
    if (!found) return std::nullopt;  // the law ends here
    if (*found) continue;
    double stable = static_cast<double>(step - 1) / num_steps;
    for (int k = 0; k < num_halvings; ++k) {
      const double middle = (stable + unstable) / 2;
      (is_stable(middle).value_or(false) ? stable : unstable) = middle;
    }
    return unstable;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ModuliAtRest> moduli_at_rest(const Law& law, const std::vector<double>& parameters) {
  const std::vector<ex> tangent = rest_tangent_of(law);
  if (tangent.empty()) return std::nullopt;
  const RestModuli moduli = moduli_of(tangent);
  const GiNaC::exmap values = values_of(law, parameters);
  const std::optional<double> lambda = value_of(moduli.lambda, values);
  const std::optional<double> mu = value_of(moduli.mu, values);
  if (!lambda || !mu) return std::nullopt;
  return ModuliAtRest{*lambda, *mu};
}

std::vector<UnstableStretch> unstable_stretches(const Law& law,
                                                const std::vector<double>& parameters) {
  const IsochoricEnergy energy(law, parameters);
  std::vector<UnstableStretch> found;
  for (const Mode& mode : modes) {
    const std::optional<double> part = find_loss(energy, mode);
    if (part) found.push_back({mode.name, std::pow(mode.furthest, *part)});
  }
  return found;
}

}  // namespace elastogen::symgen
