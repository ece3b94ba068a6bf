#include "symgen/mechanics/stabilise.h"

#include <algorithm>
#include <array>
#include <map>

#include "runtime/error.h"
#include "symgen/mechanics/functions.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::symbol;

/// Beyond, the alternating terms of (1 + j)^n lose digits under compression (four of them at n = 20
/// and J = 0.3).
constexpr int highest_degree = 8;

/// An expression near rest: rest + deviation, deviation = slope * t + remainder, where t is tr H or
/// tr E.
struct NearRest {
  ex rest;
  ex slope;
  ex remainder;
  ex deviation;  ///< as it is best computed
};

bool is_power_of_a_function(const ex& expression) {
  return GiNaC::is_a<GiNaC::power>(expression) &&
         !expression.op(1).info(GiNaC::info_flags::nonnegint) &&
         GiNaC::is_a<numeric>(expression.op(1));
}

numeric exponent_of(const ex& power) { return GiNaC::ex_to<numeric>(power.op(1)); }

/// The greatest number of which both are whole multiples; of one sign.
numeric common_unit(const numeric& a, const numeric& b) {
  const numeric unit =
      GiNaC::gcd(a.numer() * b.denom(), b.numer() * a.denom()) / (a.denom() * b.denom());
  return a.is_negative() ? -GiNaC::abs(unit) : GiNaC::abs(unit);
}

/// Rewrites one term.
class Stabiliser {
 public:
  Stabiliser(const SmallMeasures& measures, bool by_strain)
      : measures_(measures), deviations_(by_strain ? measures.by_strain : measures.by_gradient) {}

  StabilisedTerm run(const LawTerm& term, const std::vector<Parameter>& parameters) {
    const GiNaC::possymbol j("J");
    const GiNaC::exmap changes = {{j, 1 + measures_.volume_change},
                                  {find_invariant("I1").symbol, 3 + measures_.i1_change},
                                  {find_invariant("I2").symbol, 3 + measures_.i2_change}};
    const ex in_changes = resolve_powers_of_j(term.expression, j).subs(changes);
    collect_exponents(in_changes);
    const ex polynomial = without_functions(in_changes);
    if (!is_polynomial(polynomial)) return {by_value(polynomial), false};
    const NearRest parts = near_rest(polynomial);
    if (!parts.rest.normal().is_zero() || !parts.slope.is_zero()) {
      throw InternalError("term '" + term.name + "' is not stress-free at rest");
    }
    return {take_out_parameters(by_value(parts.remainder.expand()), parameters), true};
  }

 private:
  [[nodiscard]] bool depends_on_deformation(const ex& expression) const {
    return std::any_of(deviations_.begin(), deviations_.end(),
                       [&](const Deviation& d) { return expression.has(d.symbol); });
  }

  /// A polynomial of a degree low enough to be expanded.
  [[nodiscard]] bool is_polynomial(const ex& expression) const {
    return std::all_of(deviations_.begin(), deviations_.end(), [&](const Deviation& d) {
      return expression.is_polynomial(d.symbol) && expression.degree(d.symbol) <= highest_degree;
    });
  }

  /// For each base the unit of its positive and of its negative exponents.
  void collect_exponents(const ex& expression) {
    if (is_power_of_a_function(expression)) {
      const numeric exponent = exponent_of(expression);
      numeric& unit = units_[expression.op(0)][exponent.is_negative() ? 1 : 0];
      unit = unit.is_zero() ? exponent : common_unit(unit, exponent);
    }
    for (const ex& operand : expression) collect_exponents(operand);
  }

  /// With a deviation in the place of each function that is recognised, innermost first.
  ex without_functions(const ex& expression) {
    if (const auto known = replaced_.find(expression); known != replaced_.end()) {
      return known->second;
    }
    struct Inner : public GiNaC::map_function {
      explicit Inner(Stabiliser& own) : owner(own) {}
      ex operator()(const ex& operand) override { return owner.without_functions(operand); }
      Stabiliser& owner;
    } inner(*this);
    const ex mapped = expression.map(inner);
    const ex result = replaced_sum(replaced_function(expression, mapped));
    replaced_.emplace(expression, result);
    return result;
  }

  /// A sum in which first-order parts cancel: expanded within a product or a power it would leave
  /// terms of lower order than the whole.
  ex replaced_sum(const ex& sum) {
    if (!GiNaC::is_a<GiNaC::add>(sum) || !depends_on_deformation(sum) || !is_polynomial(sum)) {
      return sum;
    }
    const NearRest at = near_rest(sum);
    if (!at.rest.normal().is_zero() || !at.slope.is_zero()) return sum;
    return add(0, at.remainder, at.remainder);
  }

  ex replaced_function(const ex& expression, const ex& mapped) {
    const bool is_log = GiNaC::is_the_function<GiNaC::log_SERIAL>(mapped);
    const bool is_exp = GiNaC::is_the_function<GiNaC::exp_SERIAL>(mapped);
    const bool is_power = is_power_of_a_function(mapped);
    if (!is_log && !is_exp && !is_power) return mapped;
    const ex& argument = mapped.op(0);
    if (!depends_on_deformation(argument) || !is_polynomial(argument)) return mapped;
    const NearRest at = near_rest(argument);
    if (is_exp) return at.rest.is_zero() ? 1 + exponential(at) : mapped;
    if (!GiNaC::is_a<numeric>(at.rest) || !GiNaC::ex_to<numeric>(at.rest).is_positive()) {
      return mapped;
    }
    const numeric rest = GiNaC::ex_to<numeric>(at.rest);
    const NearRest relative = {1, at.slope / rest, at.remainder / rest, at.deviation / rest};
    if (is_log) return GiNaC::log(rest) + logarithm(relative);
    const numeric exponent = exponent_of(mapped);
    const ex factor = GiNaC::pow(rest, exponent);
    if (!factor.info(GiNaC::info_flags::rational) && exponent.denom() != 2) return mapped;
    const auto known = units_.find(expression.op(0));
    const numeric unit =
        known == units_.end() ? exponent : known->second[exponent.is_negative() ? 1 : 0];
    return factor * GiNaC::pow(1 + power(relative, unit), exponent / unit);
  }

  /// A polynomial in deviations. One that stands alone, times something of order zero, is
  /// slope * t + remainder; all other monomials are of second order in small numbers.
  [[nodiscard]] NearRest near_rest(const ex& polynomial) const {
    GiNaC::exmap at_rest;
    for (const Deviation& d : deviations_) at_rest[d.symbol] = 0;
    const ex expanded = polynomial.expand();
    NearRest result{expanded.subs(at_rest), 0, 0, 0};
    result.remainder = expanded - result.rest;
    for (const Deviation& d : deviations_) {
      const ex coefficient = expanded.coeff(d.symbol, 1).subs(at_rest);
      result.slope += coefficient * d.slope;
      result.remainder += coefficient * (d.remainder - d.symbol);
    }
    result.slope = result.slope.normal();
    // Where first-order parts cancel, the sum of the deviations would lose digits.
    result.deviation =
        result.slope.is_zero() ? result.remainder : (expanded - result.rest).expand();
    return result;
  }

  ex add(const ex& slope, const ex& remainder, const ex& value) {
    deviations_.push_back({symbol("deviation"), slope, remainder, value});
    return deviations_.back().symbol;
  }

  /// log(1 + x)
  ex logarithm(const NearRest& x) {
    return add(x.slope, x.remainder - log1p_remainder(x.deviation), log1p(x.deviation));
  }

  /// exp(y) - 1
  ex exponential(const NearRest& y) {
    const ex second = expm1_remainder(y.deviation);
    return add(y.slope, y.remainder + second, y.deviation + second);
  }

  /// (1 + x)^a - 1
  ex power(const NearRest& x, const numeric& a) {
    if (a == -1) {
      const ex inverse = GiNaC::pow(1 + x.deviation, -1);
      return add(-x.slope, GiNaC::pow(x.deviation, 2) * inverse - x.remainder,
                 -x.deviation * inverse);
    }
    const ex from_log = log1p_remainder(x.deviation);
    const ex logarithm = a * (x.deviation - from_log);
    const ex second = expm1_remainder(logarithm);
    return add(a * x.slope, a * x.remainder + second - a * from_log, logarithm + second);
  }

  /// With what deviations of functions stand for, the last made first: it may hold others.
  [[nodiscard]] ex by_value(const ex& expression) const {
    ex result = expression;
    for (auto d = deviations_.rbegin(); d != deviations_.rend(); ++d) {
      if (!d->value.is_equal(d->symbol)) result = result.subs(d->symbol == d->value);
    }
    return result;
  }

  /// Takes out the powers of parameters that all summands share. (GiNaC's own gcd leaves a numeric
  /// factor whose sign depends on the order of symbols, hence on the run.)
  [[nodiscard]] static ex take_out_parameters(const ex& sum,
                                              const std::vector<Parameter>& parameters) {
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

  const SmallMeasures& measures_;
  std::vector<Deviation> deviations_;
  std::map<ex, std::array<numeric, 2>, GiNaC::ex_is_less> units_;
  std::map<ex, ex, GiNaC::ex_is_less> replaced_;
};

}  // namespace

StabilisedTerm stabilise(const LawTerm& term, const std::vector<Parameter>& parameters,
                         const SmallMeasures& measures, bool by_strain) {
  return Stabiliser(measures, by_strain).run(term, parameters);
}

}  // namespace elastogen::symgen
