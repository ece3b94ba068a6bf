#include "symgen/mechanics/energy.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "symgen/mechanics/functions.h"
#include "symgen/mechanics/small_measures.h"
#include "temporary_law.h"
#include "tests/unit/symgen/relative_error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

ex definition(const EnergyDensity& energy, const std::string& name) {
  for (const Definition& definition : energy.definitions) {
    if (definition.symbol.get_name() == name) return definition.symbol;
  }
  throw std::runtime_error("no definition " + name);
}

EnergyDensity stabilised(const Law& law, int dim = 3) { return energy_density(law, dim, {true}); }
EnergyDensity textbook(const Law& law, int dim = 3) { return energy_density(law, dim, {false}); }

/// Random exact values: a gradient with entries up to `size`, parameters between 1 and 3.
GiNaC::exmap random_state(const Law& law, int dim, const numeric& size, std::mt19937& generator) {
  std::uniform_int_distribution<int> entry(-1000, 1000);
  GiNaC::exmap values;
  for (const GiNaC::symbol& h : displacement_gradient(dim)) {
    values[h] = size * numeric(entry(generator), 1000);
  }
  for (const Parameter& parameter : law.parameters) {
    values[parameter.symbol] = 2 + numeric(entry(generator), 1000);
  }
  return values;
}

numeric evaluate(const ex& expression, const GiNaC::exmap& values) {
  return GiNaC::ex_to<numeric>(expression.subs(values).evalf());
}

TEST(EnergyDensity, OfNeoHookeanHasNoFirstOrderPart) {
  const Law law = shipped_law("neo_hookean");
  const EnergyDensity energy = stabilised(law);
  const ex lambda = law.parameters[0].symbol, mu = law.parameters[1].symbol;
  const ex j = definition(energy, "j");
  EXPECT_TRUE(energy.terms[0].is_equal(
      mu * (definition(energy, "q") / 2 - definition(energy, "k") + log1p_remainder(j))))
      << energy.terms[0];
  EXPECT_TRUE(energy.terms[1].is_equal(lambda / 2 * GiNaC::pow(log1p(j), 2))) << energy.terms[1];
  for (const Definition& entry : energy.definitions) {
    if (ex(entry.symbol).is_equal(j)) {
      EXPECT_TRUE(entry.value.is_equal(definition(energy, "t") + definition(energy, "k")));
    }
  }
  EXPECT_EQ(energy.stabilised, (std::vector<bool>{true, true}));
}

TEST(EnergyDensity, OfStvkKeepsItsDefinitionsNested) {
  const Law law = shipped_law("stvk");
  const EnergyDensity energy = stabilised(law);
  const ex lambda = law.parameters[0].symbol, mu = law.parameters[1].symbol;
  EXPECT_TRUE(energy.terms[0].is_equal(lambda / 2 * GiNaC::pow(definition(energy, "trE"), 2)));
  EXPECT_TRUE(energy.terms[1].is_equal(mu * definition(energy, "trE2")));
  std::vector<std::string> names;
  for (const Definition& entry : energy.definitions) names.push_back(entry.symbol.get_name());
  EXPECT_EQ(names,
            (std::vector<std::string>{"E00", "E01", "E02", "E11", "E12", "E22", "trE", "trE2"}));
}

TEST(EnergyDensity, OfHookeNeedsNoGreenLagrangeStrain) {
  const EnergyDensity energy = stabilised(shipped_law("hooke"));
  ASSERT_EQ(energy.definitions.size(), 2U);
  EXPECT_EQ(energy.definitions[0].symbol.get_name(), "tr_eps");
  EXPECT_EQ(energy.definitions[1].symbol.get_name(), "tr_eps2");
}

TEST(EnergyDensity, DefinitionsUseOnlyWhatStandsBeforeThem) {
  for (const char* name : {"hooke", "stvk", "neo_hookean"}) {
    for (const bool stabilise : {true, false}) {
      const EnergyDensity energy = energy_density(shipped_law(name), 3, {stabilise});
      for (std::size_t i = 0; i < energy.definitions.size(); ++i) {
        for (std::size_t later = i; later < energy.definitions.size(); ++later) {
          EXPECT_FALSE(energy.definitions[i].value.has(energy.definitions[later].symbol)) << name;
        }
      }
    }
  }
}

struct Form {
  const char *name, *energy;
  bool is_stabilised;
};

const std::vector<Form> recognised_forms = {
    {"Hooke", "lambda/2*tr_eps^2 + mu*tr_eps2", true},
    {"Stvk", "lambda/2*trE^2 + mu*trE2", true},
    {"NeoHookean", "mu/2*(I1 - 3) - mu*log(J) + lambda/2*log(J)^2", true},
    {"NeoHookeanByI3", "mu/2*(I1 - 3) - mu/2*log(I3) + lambda/8*log(I3)^2", true},
    {"NeoHookeanByStrain", "mu*(trE - log(J)) + lambda/2*(sqrt(I3) - 1)^2", true},
    {"SimoMiehe", "mu*(I1 - 3 - 2*log(J)) + lambda/4*(J^2 - 1 - 2*log(J))", true},
    {"MooneyRivlin", "mu*(I1 - 3) + lambda*(I2 - 3) - (2*mu + 4*lambda)*log(J)", true},
    {"Yeoh", "mu*(I1 - 3 - 2*log(J)) + lambda*(I1 - 3)^3", true},
    {"SecondOrderByI2", "lambda*(J - 1)^2 + mu*((I1 - 3)^2 - 2*(I2 - 3) + 4*(I1 - 3))", true},
    {"Isochoric", "mu/2*(I1*J^(-2/3) - 3) + lambda/2*(J - 1)^2", true},
    {"IsochoricByI3", "mu/2*(I1*I3^(-1/3) - 3) + lambda*(I2*I3^(-2/3) - 3)", true},
    {"IsochoricCubed", "mu*(I1*J^(-2/3) - 3)^3 + lambda*(J - 1)^2", true},
    {"IsochoricProduct", "mu*(I1*J^(-2/3) - 3)*(I2*J^(-4/3) - 3) + lambda*(J - 1)^2", true},
    {"PowersOfBothSigns", "mu*(J^(3/2) + 3/2*J^(-1) - 5/2) + lambda*(J^(1/2) + 1/2/J - 3/2)", true},
    {"Exponential", "mu*trE2 + lambda*(exp(trE^2) - 1)", true},
    {"ExponentialOfI1", "mu*(exp(I1 - 3) - 1 - 2*log(J)) + lambda*log(J)^2", true},
    {"Reciprocal", "mu*(I1/J^2 - 3 + 4*log(J)) + lambda*trE2", true},
    {"Gent", "-mu*log(1 - (I1 - 3)/97) - 2/97*mu*log(J) + lambda*log(J)^2", true},
    {"StableNeoHookean",
     "mu/2*(I1 - 3) - mu/2*log((I1 + 1)/4) + lambda/2*((J - 1 - 3*mu/(4*lambda))^2 - "
     "(3*mu/(4*lambda))^2)",
     true},
    {"Nested", "mu*(log(1 + trE2) + exp(1 - 1/J) - J) + lambda*sqrt(1 + trE^2) - lambda", true}};

const std::vector<Form> other_forms = {
    {"CubeRootOfThree", "mu*(I1^(1/3)*J^(-2/9) - 3^(1/3)) + lambda*trE2", false},
    {"HighPower", "mu*trE2 + lambda*(J^20 - 20*J + 19)", false},
    {"ExponentialOfOne", "mu*trE2 + lambda*(exp(J) - exp(1)*J)", false}};

const auto form_name = [](const auto& form) { return std::string(form.param.name); };

class EveryForm : public testing::TestWithParam<Form> {
 protected:
  EveryForm() { GiNaC::Digits = 60; }
  ~EveryForm() override { GiNaC::Digits = 17; }
};

TEST_P(EveryForm, EqualsTheTextbookFormWithItsDerivatives) {
  const Law law = law_with_term(GetParam().energy);
  SCOPED_TRACE("seed 7");
  std::mt19937 generator(7);
  for (const int dim : {2, 3}) {
    const ex stable = flatten_term(stabilised(law, dim), 0);
    const ex plain = flatten_term(textbook(law, dim), 0);
    for (int trial = 0; trial < 3; ++trial) {
      const GiNaC::exmap values = random_state(law, dim, numeric(1, 4), generator);
      EXPECT_LT(relative_error(evaluate(stable, values), evaluate(plain, values)), 1e-50)
          << dim << "D";
      for (const GiNaC::symbol& h : displacement_gradient(dim)) {
        EXPECT_LT(relative_error(evaluate(stable.diff(h), values), evaluate(plain.diff(h), values)),
                  1e-50)
            << dim << "D, d/d" << h;
      }
    }
  }
}

TEST_P(EveryForm, IsStressFreeAtRest) {
  const Law law = law_with_term(GetParam().energy);
  for (const bool stabilise : {true, false}) {
    const ex term = flatten_term(energy_density(law, 3, {stabilise}), 0);
    GiNaC::exmap rest;
    for (const GiNaC::symbol& h : displacement_gradient(3)) rest[h] = 0;
    EXPECT_TRUE(term.subs(rest).normal().is_zero());
    for (const GiNaC::symbol& h : displacement_gradient(3)) {
      EXPECT_TRUE(term.diff(h).subs(rest).normal().is_zero()) << "d/d" << h;
    }
  }
}

TEST_P(EveryForm, SaysWhetherItIsStabilised) {
  EXPECT_EQ(stabilised(law_with_term(GetParam().energy)).stabilised.front(),
            GetParam().is_stabilised);
}

class RecognisedForm : public EveryForm {};

/// Remainders written out, and exp(a log b) as b^a.
struct WriteOut : public GiNaC::map_function {
  ex operator()(const ex& expression) override {
    const ex mapped = expression.map(*this);
    if (GiNaC::is_the_function<log1p_SERIAL>(mapped)) return logarithm(1 + mapped.op(0));
    if (GiNaC::is_the_function<log1p_remainder_SERIAL>(mapped)) {
      return mapped.op(0) - logarithm(1 + mapped.op(0));
    }
    if (GiNaC::is_the_function<GiNaC::log_SERIAL>(mapped)) return logarithm(mapped.op(0));
    if (GiNaC::is_a<GiNaC::power>(mapped)) return GiNaC::pow(mapped.op(0).expand(), mapped.op(1));
    if (GiNaC::is_the_function<expm1_remainder_SERIAL>(mapped)) {
      return exponential(mapped.op(0).expand()) - 1 - mapped.op(0);
    }
    if (GiNaC::is_the_function<GiNaC::exp_SERIAL>(mapped)) {
      return exponential(mapped.op(0).expand());
    }
    return mapped;
  }
  static ex logarithm(const ex& argument) {
    const ex x = argument.expand();
    const bool is_power_of_positive =
        GiNaC::is_a<GiNaC::power>(x) && x.op(0).info(GiNaC::info_flags::positive);
    return is_power_of_positive ? x.op(1) * GiNaC::log(x.op(0)) : GiNaC::log(x);
  }
  static ex exponential(const ex& y) {
    const std::size_t count = GiNaC::is_a<GiNaC::add>(y) ? y.nops() : 1;
    ex product = 1, rest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const ex summand = GiNaC::is_a<GiNaC::add>(y) ? y.op(i) : y;
      GiNaC::exmap found;
      if (summand.match(GiNaC::wild(0) * GiNaC::log(GiNaC::wild(1)), found) &&
          GiNaC::is_a<numeric>(found[GiNaC::wild(0)])) {
        product *= GiNaC::pow(found[GiNaC::wild(1)], found[GiNaC::wild(0)]);
      } else {
        rest += summand;
      }
    }
    return product * GiNaC::exp(rest);
  }
};

// With I1, I2 and J as symbols, J > 0, the measures q, s and k follow from t, and both forms are
// the same expression; t cancels.
TEST_P(RecognisedForm, EqualsTheTextbookFormSymbolically) {
  const Law law = law_with_term(GetParam().energy);
  const EnergyDensity energy = stabilised(law);
  const GiNaC::symbol t("t"), i1("I1"), i2("I2");
  const GiNaC::possymbol j("J");
  const ex q = i1 - 3 - 2 * t, trace = t + q / 2;
  const std::map<std::string, ex> measures = {{"t", t},         {"q", q},
                                              {"k", j - 1 - t}, {"s", (i2 - 3 - 4 * t - 2 * q) / 4},
                                              {"j", j - 1},     {"dI1", i1 - 3},
                                              {"dI2", i2 - 3},  {"trE", trace},
                                              {"tr_eps", t},    {"a", trace - j + 1}};
  GiNaC::exmap known, invariant;
  for (const Definition& entry : energy.definitions) {
    const auto found = measures.find(entry.symbol.get_name());
    if (found != measures.end()) known[entry.symbol] = found->second;
  }
  for (const auto& [name, value] : std::map<std::string, ex>{{"I1", i1},
                                                             {"I2", i2},
                                                             {"I3", GiNaC::pow(j, 2)},
                                                             {"J", j},
                                                             {"trE", trace},
                                                             {"tr_eps", t}}) {
    invariant[find_invariant(name).symbol] = value;
  }
  WriteOut write_out;
  const ex plain = write_out(law.terms[0].expression.subs(invariant));
  for (const ex& form : {energy.terms[0], energy.values[0]}) {
    const ex difference = write_out(form.subs(known)) - plain;
    EXPECT_TRUE(difference.expand().normal().expand().is_zero()) << difference;
  }
}

// What `a` stands for, and that det C follows from E.
TEST(SmallMeasures, DifferenceOfTraceAndVolumeChange) {
  for (const int dim : {2, 3}) {
    const SmallMeasures measures = small_measures(dim);
    const auto value = [&](const std::string& name) {
      for (const Definition& entry : measures.definitions) {
        if (entry.symbol.get_name() == name) {
          return substitute_definitions(entry.symbol, measures.definitions);
        }
      }
      throw std::runtime_error("no definition " + name);
    };
    const ex a = value("a").subs(negative_part(GiNaC::wild()) == 0);  // J > 0
    const ex j = value("j"), trace = value("trE");
    EXPECT_TRUE((a * (2 + j) - (trace - j) * (2 + j)).normal().expand().is_zero()) << dim;
  }
}

// In arithmetic of 17 digits at strains of 1e-10 the stabilised stress keeps its digits; the
// textbook's has lost ten of them wherever first-order parts cancel.
TEST_P(RecognisedForm, KeepsItsDigitsNearRest) {
  const Law law = law_with_term(GetParam().energy);
  const ex stable = flatten_term(stabilised(law), 0);
  SCOPED_TRACE("seed 11");
  std::mt19937 generator(11);
  const GiNaC::exmap exact = random_state(law, 3, numeric(10).power(numeric(-10)), generator);
  numeric largest = 0, worst = 0;
  for (const GiNaC::symbol& h : displacement_gradient(3)) {
    const ex stress = stable.diff(h);
    GiNaC::Digits = 60;
    const numeric reference = evaluate(stress, exact);
    GiNaC::Digits = 17;
    GiNaC::exmap rounded;
    for (const auto& [symbol, value] : exact) rounded[symbol] = value.evalf();
    const numeric value = evaluate(stress, rounded);
    largest = std::max(largest, numeric(GiNaC::abs(reference)));
    worst = std::max(worst, numeric(GiNaC::abs(value - reference)));
  }
  EXPECT_LT((worst / largest).to_double(), 1e-17);
}

INSTANTIATE_TEST_SUITE_P(Stabilised, EveryForm, testing::ValuesIn(recognised_forms), form_name);
INSTANTIATE_TEST_SUITE_P(Others, EveryForm, testing::ValuesIn(other_forms), form_name);
INSTANTIATE_TEST_SUITE_P(Stabilised, RecognisedForm, testing::ValuesIn(recognised_forms),
                         form_name);

TEST(EnergyDensity, TextbookNeoHookeanLosesDigitsNearRest) {
  const Law law = law_with_term("mu/2*(I1 - 3) - mu*log(J) + lambda/2*log(J)^2");
  const ex plain = flatten_term(textbook(law), 0);
  SCOPED_TRACE("seed 11");
  std::mt19937 generator(11);
  const GiNaC::exmap exact = random_state(law, 3, numeric(10).power(numeric(-10)), generator);
  GiNaC::exmap rounded;
  for (const auto& [symbol, value] : exact) rounded[symbol] = value.evalf();
  const ex stress = plain.diff(displacement_gradient(3)[0]);
  const numeric value = evaluate(stress, rounded);
  GiNaC::Digits = 60;
  const numeric reference = evaluate(stress, exact);
  GiNaC::Digits = 17;
  EXPECT_GT(relative_error(value, reference), 1e-11);
}

}  // namespace
}  // namespace elastogen::symgen
