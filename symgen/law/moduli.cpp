#include "symgen/law/moduli.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "symgen/law/expression_text.h"
#include "symgen/law/rest_state.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

bool admits_all(const Law& law, const GiNaC::exmap& values) {
  return std::all_of(law.parameters.begin(), law.parameters.end(), [&](const Parameter& p) {
    const ex number = values.at(p.symbol).evalf();
    return GiNaC::is_a<numeric>(number) && GiNaC::ex_to<numeric>(number).is_real() &&
           is_admissible(p, GiNaC::ex_to<numeric>(number));
  });
}

std::vector<ParameterSample> samples_by_young_poisson(const Law& law) {
  const GiNaC::exmap formulas = parameters_of_young_poisson(law);
  std::vector<ParameterSample> samples;
  for (const numeric& poisson :
       {numeric(1, 4), numeric(3, 10), numeric(2, 5), numeric(49, 100), numeric(4999, 10000),
        numeric(0), numeric(-1, 2), numeric(-9, 10)}) {
    ParameterSample sample{fmt::format("young = 1, poisson = {}", expression_text(poisson)), {}};
    try {
      for (const auto& [symbol, formula] : formulas) {
        sample.values[symbol] =
            formula.subs(GiNaC::exmap{{young_modulus(), 1}, {poisson_ratio(), poisson}});
      }
    } catch (const std::exception&) {  // GiNaC's, at a pole: no such material
      continue;
    }
    if (admits_all(law, sample.values)) samples.push_back(std::move(sample));
  }
  return samples;
}

/// Bounds, values near them, and values far from them; a value of middle size first.
std::vector<numeric> candidates_of(const Parameter& parameter) {
  const numeric small(1, 1000), large(1000);
  std::vector<numeric> all;
  if (parameter.minimum && parameter.maximum) {
    const numeric low = *parameter.minimum, size = *parameter.maximum - low;
    for (const numeric& part :
         {numeric(1, 2), small, numeric(1, 4), numeric(3, 4), 1 - small, numeric(0), numeric(1)}) {
      all.push_back(low + part * size);
    }
  } else if (parameter.minimum) {
    for (const numeric& step : {numeric(1), small, large, numeric(0)}) {
      all.push_back(*parameter.minimum + step);
    }
  } else if (parameter.maximum) {
    for (const numeric& step : {numeric(1), small, large, numeric(0)}) {
      all.push_back(*parameter.maximum - step);
    }
  } else {
    all = {1, small, large, 0, -1, -small, -large};
  }
  std::erase_if(all, [&](const numeric& value) { return !is_admissible(parameter, value); });
  return all;
}

std::vector<ParameterSample> samples_by_ranges(const Law& law) {
  constexpr std::size_t most = 500;
  std::vector<std::vector<numeric>> candidates;
  std::size_t combinations = 1;
  for (const Parameter& parameter : law.parameters) {
    candidates.push_back(candidates_of(parameter));
    combinations = std::min(most + 1, combinations * candidates.back().size());
  }
  std::mt19937 generator(1);
  std::vector<ParameterSample> samples;
  for (std::size_t k = 0; k < std::min(combinations, most); ++k) {
    ParameterSample sample;
    std::size_t rest = k;
    for (std::size_t p = 0; p < candidates.size(); ++p) {
      const std::size_t count = candidates[p].size();
      const bool all_combinations = combinations <= most;
      const numeric& value =
          candidates[p][all_combinations || k == 0 ? rest % count : generator() % count];
      rest /= count;
      sample.values[law.parameters[p].symbol] = value;
      sample.text += fmt::format("{}{} = {}", p == 0 ? "" : ", ", law.parameters[p].name,
                                 expression_text(value));
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

/// A sum of products that is positive term by term.
bool is_positive_sum(const ex& sum, const Law& law) {
  const ex expanded = sum.expand();
  const auto sign_of = [&](const ex& product) {  // -1 unknown, 0 not negative, 1 positive
    ex coefficient = product;
    int sign = 1;
    for (const Parameter& parameter : law.parameters) {
      if (!coefficient.is_polynomial(parameter.symbol)) return -1;  // a root, say
      const int degree = coefficient.degree(parameter.symbol);
      if (degree == 0) continue;
      coefficient = coefficient.coeff(parameter.symbol, degree);
      if (!parameter.minimum || parameter.minimum->is_negative()) return -1;
      if (parameter.minimum->is_zero() && !parameter.minimum_exclusive) sign = 0;
    }
    const bool is_positive =
        GiNaC::is_a<numeric>(coefficient) && GiNaC::ex_to<numeric>(coefficient).is_positive();
    return is_positive ? sign : -1;
  };
  bool some_positive = false;
  const auto is_sound = [&](const ex& product) {
    const int sign = sign_of(product);
    some_positive = some_positive || sign == 1;
    return sign >= 0;
  };
  if (!GiNaC::is_a<GiNaC::add>(expanded)) return is_sound(expanded) && some_positive;
  return std::all_of(expanded.begin(), expanded.end(), is_sound) && some_positive;
}

}  // namespace

std::vector<ex> rest_tangent_of(const Law& law) {
  std::vector<ex> tangent(81, 0);
  for (const LawTerm& term : law.terms) {
    const std::vector<ex> part = rest_tangent(term.expression);
    if (part.empty()) return {};
    for (std::size_t c = 0; c < tangent.size(); ++c) tangent[c] += part[c];
  }
  return tangent;
}

RestModuli moduli_of(const std::vector<ex>& tangent) {
  const auto entry = [&](int i, int j, int k, int l) {
    return tangent[static_cast<std::size_t>((i * 3 + j) * 9 + k * 3 + l)];
  };
  return {entry(0, 0, 1, 1).normal(), ((entry(0, 1, 0, 1) + entry(0, 1, 1, 0)) / 2).normal()};
}

bool follows_from_young_poisson(const Law& law) {
  return std::none_of(law.parameters.begin(), law.parameters.end(),
                      [](const Parameter& p) { return p.from_young_poisson.empty(); });
}

RestModuli moduli_of_young_poisson() {
  const ex &young = young_modulus(), &poisson = poisson_ratio();
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

GiNaC::exmap parameters_of_young_poisson(const Law& law) {
  GiNaC::exmap formulas;
  for (const Parameter& parameter : law.parameters) {
    formulas[parameter.symbol] = parameter.young_poisson_formula;
  }
  return formulas;
}

std::vector<ParameterSample> admissible_samples(const Law& law) {
  return follows_from_young_poisson(law) ? samples_by_young_poisson(law) : samples_by_ranges(law);
}

bool is_plainly_positive(const ex& expression, const Law& law) {
  const ex quotient = expression.normal();
  for (const Parameter& parameter : law.parameters) {
    if (!quotient.is_polynomial(parameter.symbol) &&
        !quotient.numer_denom().op(1).is_polynomial(parameter.symbol)) {
      return false;
    }
  }
  return is_positive_sum(quotient.numer(), law) && is_positive_sum(quotient.denom(), law);
}

}  // namespace elastogen::symgen
