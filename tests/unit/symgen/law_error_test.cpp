// What a law file with one mistake gets: one test per mistake.
#include <gtest/gtest.h>

#include "temporary_law.h"

namespace elastogen::symgen {
namespace {

/// A sound law; each case replaces one piece of it.
const std::string sound_law = R"toml(name = "own"
title = "Own law"
[[parameter]]
name = "mu"
unit = "Pa"
minimum = 0
maximum = 1e12
from_young_poisson = "young/(2*(1 + poisson))"
[[term]]
name = "shear"
energy = "mu*trE2"
)toml";

struct Mistake {
  const char *name, *from, *to, *message;
};

class LawMistake : public testing::TestWithParam<Mistake> {};

TEST_P(LawMistake, IsNamedWithFileAndLine) {
  std::string law = sound_law;
  const std::string from = GetParam().from;
  const std::size_t begin = law.find(from);
  ASSERT_NE(begin, std::string::npos);
  law.replace(begin, from.size(), GetParam().to);
  const std::string message = error_of_text("own", law);
  EXPECT_EQ(message.find(GetParam().message), 0U) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, LawMistake,
    testing::Values(
        Mistake{"NotToml", "title = ", "title ", "own.toml:2: not valid TOML: "},
        Mistake{"UnknownKey", "title", "titel",
                "own.toml:2: law: unknown key 'titel'; did you mean 'title'?; allowed are name, "
                "title, source, small_strain, moduli, parameter, term"},
        Mistake{"UnknownParameterKey", "unit", "units",
                "own.toml:5: parameter 'mu': unknown key 'units'; did you mean 'unit'?"},
        Mistake{"UnknownUnit", "unit = \"Pa\"", "unit = \"kPa\"",
                "own.toml:5: parameter 'mu': unit: \"kPa\": 'kPa' has a prefix, and values are "
                "taken in SI units without one: write Pa and give values in it (1 kPa = 1e3 Pa)"},
        Mistake{"EnergyInWrongUnit", "mu*trE2", "mu*trE2 + 2*mu^2*trE^2",
                "own.toml:11: term 'shear': energy: '2*mu^2*trE^2' is in Pa^2 (mu is in Pa), must "
                "be in J/m^3 (Pa): multiply it by something in 1/Pa"},
        Mistake{"EnergyWithoutModulus", "mu*trE2", "mu*trE2 + trE^2",
                "own.toml:11: term 'shear': energy: 'trE^2' is a plain number, must be in J/m^3 "
                "(Pa): multiply it by a parameter in Pa"},
        Mistake{"ExponentialOfStress", "mu*trE2", "mu*(exp(mu*trE2) - 1)",
                "own.toml:11: term 'shear': energy: in 'exp(mu*trE2)', the argument 'mu*trE2' is "
                "in Pa, must be a plain number"},
        Mistake{
            "ParameterInWrongUnit", "unit = \"Pa\"", "unit = \"Pa*s\"",
            "own.toml:8: parameter 'mu': from_young_poisson: '1/2*young/(1 + poisson)' is in Pa "
            "(young is in Pa), must be in Pa*s: multiply it by something in s"},
        Mistake{"ModuliInWrongUnit", "[[term]]",
                "[moduli]\nlambda = \"0\"\nmu = \"mu^2\"\n[[term]]",
                "own.toml:11: moduli: mu: 'mu^2' is in Pa^2 (mu is in Pa), must be in Pa"},
        Mistake{"LeadingUnderscore", "name = \"mu\"", "name = \"_mu\"",
                "own.toml:4: parameter '_mu': name '_mu' is no identifier: use a letter"},
        Mistake{"UnknownTermKey", "energy", "energie",
                "own.toml:11: term 'shear': unknown key 'energie'; did you mean 'energy'?"},
        Mistake{"SymbolicExponent", "mu*trE2", "mu*(J^mu - 1)^2",
                "own.toml:11: term 'shear': energy: 'J^mu': an exponent must be a rational "
                "number"},
        Mistake{"HugeExponent", "mu*trE2", "mu*trE2^5000",
                "own.toml:11: term 'shear': energy: 'trE2^5000': an exponent p/q must have "
                "|p| <= 1000"},
        Mistake{"HugeNumber", "mu*trE2", "mu*trE2*1e200",
                "own.toml:11: term 'shear': energy: number 1000"},
        Mistake{"RootOfNegative", "mu*trE2", "mu*(-8)^(1/3)*trE2",
                "own.toml:11: term 'shear': energy: '(-8)^(1/3)': a root must be of a positive"},
        Mistake{"NameMissing", "name = \"own\"\n", "", "own.toml:1: law: key 'name' is missing"},
        Mistake{"UnitMissing", "unit = \"Pa\"\n", "",
                "own.toml:3: parameter 'mu': key 'unit' is missing; add unit = "},
        Mistake{"EnergyMissing", "energy = \"mu*trE2\"\n", "",
                "own.toml:9: term 'shear': key 'energy' is missing"},
        Mistake{"NameNoIdentifier", "\"own\"", "\"own-law\"",
                "own.toml:1: law: name 'own-law' is no identifier"},
        Mistake{"NameDiffersFromFile", "\"own\"", "\"mine\"",
                "own.toml:1: law: name 'mine' differs from the file's, 'own'"},
        Mistake{"ParameterNoIdentifier", "\"mu\"", "\"2mu\"",
                "own.toml:4: parameter '2mu': name '2mu' is no identifier"},
        Mistake{"ParameterIsInvariant", "\"mu\"", "\"I1\"",
                "own.toml:4: parameter 'I1': name 'I1' means something else in expressions"},
        Mistake{"ParameterIsFunction", "\"mu\"", "\"exp\"",
                "own.toml:4: parameter 'exp': name 'exp' means something else in expressions"},
        Mistake{"ParameterIsConstant", "\"mu\"", "\"Pi\"",
                "own.toml:4: parameter 'Pi': name 'Pi' means something else in expressions"},
        Mistake{"DuplicateParameter", "[[term]]",
                "[[parameter]]\nname = \"mu\"\nunit = \"1\"\n[[term]]",
                "own.toml:10: parameter 'mu': name 'mu' is taken twice"},
        Mistake{"DuplicateTerm", "[[term]]",
                "[[term]]\nname = \"shear\"\nenergy = \"mu*trE2\"\n[[term]]",
                "own.toml:13: term 'shear': name 'shear' is taken twice"},
        Mistake{"UnusedParameter", "[[term]]",
                "[[parameter]]\nname = \"kappa\"\nunit = \"Pa\"\n[[term]]",
                "own.toml:9: parameter 'kappa' is used by no term"},
        Mistake{"NumberForString", "\"Pa\"", "1",
                "own.toml:5: parameter 'mu': 'unit' is a number, must be a string"},
        Mistake{"StringForNumber", "minimum = 0", "minimum = \"0\"",
                "own.toml:6: parameter 'mu': 'minimum' is a string, must be a number"},
        Mistake{"NumberForFlag", "minimum = 0", "minimum = 0\nminimum_exclusive = 1",
                "own.toml:7: parameter 'mu': 'minimum_exclusive' is a number, must be true or "
                "false"},
        Mistake{"InfiniteBound", "1e12", "inf",
                "own.toml:7: parameter 'mu': 'maximum' is inf, must be finite"},
        Mistake{"EmptyRange", "1e12", "-1",
                "own.toml:7: parameter 'mu': no value lies between 'minimum' and 'maximum'"},
        Mistake{"EmptyOpenRange", "1e12", "0\nmaximum_exclusive = true",
                "own.toml:7: parameter 'mu': no value lies between 'minimum' and 'maximum'"},
        Mistake{"ExclusiveWithoutBound", "minimum = 0", "minimum_exclusive = true",
                "own.toml:6: parameter 'mu': 'minimum_exclusive' without 'minimum'"},
        Mistake{"BlankString", "\"Pa\"", "\" \"", "own.toml:5: parameter 'mu': 'unit' is empty"},
        Mistake{"EmptyEnergy", "\"mu*trE2\"", "\"\"",
                "own.toml:11: term 'shear': 'energy' is empty"},
        Mistake{"EnergyIsNumber", "\"mu*trE2\"", "3",
                "own.toml:11: term 'shear': 'energy' is a number, must be a string"},
        Mistake{"UnknownSymbol", "mu*trE2", "mu*tre2",
                "own.toml:11: term 'shear': energy: \"mu*tre2\": unknown symbol 'tre2' at column "
                "4; did you mean 'trE2'?; allowed are parameters mu; invariants trE, trE2, tr_eps, "
                "tr_eps2, I1, I2, I3, J; functions log, sqrt, exp"},
        Mistake{"GreekLetter", "mu*trE2", "µ*trE2",
                "own.toml:11: term 'shear': energy: \"µ*trE2\": column 1: 'µ' cannot stand here; "
                "allowed are numbers, names (ASCII letters, digits and '_') and + - * / ^ ( ); "
                "write mu for it"},
        Mistake{"DoesNotParse", "mu*trE2", "mu*(trE2",
                "own.toml:11: term 'shear': energy: \"mu*(trE2\": 1 closing ')' missing"},
        Mistake{"YoungPoissonDoesNotParse", "2*(1 + poisson)", "2*(1 + nu)",
                "own.toml:8: parameter 'mu': from_young_poisson: \"young/(2*(1 + nu))\": unknown "
                "symbol 'nu'"},
        Mistake{"ZeroEnergy", "mu*trE2", "mu*(trE2 - trE2)",
                "own.toml:11: term 'shear': the energy is zero for every deformation"},
        Mistake{"EnergyAtRest", "mu*trE2", "mu*(trE2 + 1)",
                "own.toml:11: term 'shear': the energy at rest (H = 0) is mu, must be 0"},
        Mistake{"StressAtRest", "mu*trE2", "mu/2*(I1 - 3)",
                "own.toml:11: term 'shear': the term is not stress-free at rest: dW/dH is (mu) "
                "times the identity"},
        Mistake{"PoleAtRest", "mu*trE2", "mu*log(trE)",
                "own.toml:11: term 'shear': the energy or its derivative is not finite at rest"},
        Mistake{"KinkAtRest", "mu*trE2", "mu*sqrt(trE2)",
                "own.toml:11: term 'shear': the energy or its derivative is not finite at rest"},
        Mistake{"TermsAreNoTables", "[[term]]\nname = \"shear\"\nenergy = \"mu*trE2\"\n",
                "[term]\nname = \"shear\"\nenergy = \"mu*trE2\"\n",
                "own.toml:9: law: 'term' must be written as tables [[term]]"},
        Mistake{"NoTerms", "[[term]]\nname = \"shear\"\nenergy = \"mu*trE2\"\n", "",
                "own.toml:1: law: there is no [[term]]; add at least one"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(LawMistake, NoParametersAreNamed) {
  const std::string message =
      error_of_text("own", "name = \"own\"\n[[term]]\nname = \"a\"\nenergy = \"trE2\"\n");
  EXPECT_NE(message.find("there is no [[parameter]]"), std::string::npos) << message;
}

TEST(LawMistake, SoundLawIsAccepted) { EXPECT_NO_THROW((void)law_from_text("own", sound_law)); }

}  // namespace
}  // namespace elastogen::symgen
