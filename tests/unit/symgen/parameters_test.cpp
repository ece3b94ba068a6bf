#include "symgen/law/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/error.h"
#include "symgen/law/law.h"
#include "temporary_law.h"
#include "tests/unit/message_of.h"

namespace elastogen::symgen {
namespace {

using test::message_of;

TEST(ParametersFromYoungPoisson, AreLame) {
  for (const char* name : {"hooke", "stvk", "neo_hookean"}) {
    const std::vector<double> values =
        parameters_from_young_poisson(shipped_law(name), 100e6, 0.25);
    ASSERT_EQ(values.size(), 2U);
    EXPECT_EQ(values[0], 40e6) << name;
    EXPECT_EQ(values[1], 40e6) << name;
  }
  EXPECT_EQ(parameters_from_young_poisson(shipped_law("stvk"), 100e6, 0),
            (std::vector<double>{0, 50e6}));
}

TEST(ParametersFromYoungPoisson, AreRoundedOnce) {
  const double young = 1e9 / 3, poisson = 0.4999;
  const std::vector<double> values =
      parameters_from_young_poisson(shipped_law("stvk"), young, poisson);
  const long double e = young, nu = poisson;
  EXPECT_EQ(values[0], static_cast<double>(e * nu / ((1 + nu) * (1 - 2 * nu))));
  EXPECT_EQ(values[1], static_cast<double>(e / (2 * (1 + nu))));
}

TEST(ParametersFromYoungPoisson, RefusePoissonOutsideItsRange) {
  const Law stvk = shipped_law("stvk");
  EXPECT_EQ(message_of<InputError>([&] { (void)parameters_from_young_poisson(stvk, 1, 0.5); }),
            "poisson = 0.5: must be in (-1, 0.5) for law 'stvk' (lambda is unbounded at 0.5); "
            "give a ratio up to 0.4999");
  EXPECT_EQ(message_of<InputError>([&] { (void)parameters_from_young_poisson(stvk, 1, -1); }),
            "poisson = -1: must be in (-1, 0.5) for law 'stvk' (lambda, mu are unbounded at -1); "
            "give a ratio from -0.9999");
  EXPECT_EQ(message_of<InputError>([&] { (void)parameters_from_young_poisson(stvk, 1, NAN); }),
            "poisson = nan: must be in (-1, 0.5) for law 'stvk'");
  EXPECT_NO_THROW((void)parameters_from_young_poisson(stvk, 1, 0.4999));
  EXPECT_NO_THROW((void)parameters_from_young_poisson(stvk, 1, -0.9999));
}

TEST(ParametersFromYoungPoisson, RefuseYoungOutsideItsRange) {
  const Law stvk = shipped_law("stvk");
  for (const double young : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(message_of<InputError>([&] {
                (void)parameters_from_young_poisson(stvk, young, 0.3);
              }).find("must be a finite number > 0 [Pa] for law 'stvk'"),
              std::string::npos);
  }
}

TEST(ParametersFromYoungPoisson, RefuseParameterThatDoesNotFollow) {
  const Law law = law_with_term("mu*trE2 + lambda*trE^2");
  EXPECT_EQ(message_of<InputError>([&] { (void)parameters_from_young_poisson(law, 1, 0.3); }),
            "parameter 'lambda' of law 'own' does not follow from young and poisson; give the "
            "law's own parameters");
}

TEST(ParametersFromYoungPoisson, RefuseParameterWithoutValue) {
  const Law law = law_from_text("own", R"(name = "own"
[[parameter]]
name = "k"
unit = "Pa"
from_young_poisson = "young/poisson"
[[term]]
name = "all"
energy = "k*trE2"
)");
  EXPECT_EQ(message_of<InputError>([&] { (void)parameters_from_young_poisson(law, 1, 0); }),
            "parameter 'k' of law 'own', young/poisson, has no real value at young = 1, "
            "poisson = 0");
}

Law law_with_range(const std::string& range) {
  return law_from_text("own", "name = \"own\"\n[[parameter]]\nname = \"k\"\nunit = \"Pa\"\n" +
                                  range + "\n[[term]]\nname = \"all\"\nenergy = \"k*trE2\"\n");
}

TEST(CheckParameters, KeepsRanges) {
  struct Range {
    const char *text, *message;
    double inside, outside;
  };
  for (const Range& range :
       {Range{"minimum = 0.1", "k = 0.09: must be >= 0.1 [Pa] for law 'own'", 0.1, 0.09},
        Range{"minimum = 0\nminimum_exclusive = true", "k = 0: must be > 0 [Pa] for law 'own'",
              1e-300, 0},
        Range{"maximum = 2", "k = 2.5: must be <= 2 [Pa] for law 'own'", 2, 2.5},
        Range{"maximum = 2\nmaximum_exclusive = true", "k = 2: must be < 2 [Pa] for law 'own'", 1.5,
              2},
        Range{"minimum = 1\nmaximum = 2\nmaximum_exclusive = true",
              "k = 2: must be in [1, 2) [Pa] for law 'own'", 1, 2}}) {
    const Law law = law_with_range(range.text);
    EXPECT_NO_THROW(check_parameters(law, {range.inside})) << range.text;
    EXPECT_EQ(message_of<InputError>([&] { check_parameters(law, {range.outside}); }),
              range.message);
  }
}

TEST(CheckParameters, RefuseWhatHasLostItsDigits) {
  const Law law = law_with_range("minimum = 0");
  EXPECT_EQ(message_of<InputError>([&] { check_parameters(law, {1e-310}); }),
            "k = 1e-310: must be 0 or at least 2.23e-308 in size, where double precision has all "
            "its digits [Pa] for law 'own'");
  EXPECT_NO_THROW(check_parameters(law, {0}));
  EXPECT_NO_THROW(check_parameters(law, {std::numeric_limits<double>::min()}));
}

TEST(ParametersFromYoungPoisson, RefuseModuliBeyondDoublePrecision) {
  const Law stvk = shipped_law("stvk");
  const auto message = [&](double young, double poisson) {
    return message_of<InputError>(
        [&] { (void)parameters_from_young_poisson(stvk, young, poisson); });
  };
  EXPECT_NO_THROW((void)parameters_from_young_poisson(stvk, 1e-300, 0.25));
  EXPECT_EQ(message(1e-310, 0.25),
            "young = 1e-310, poisson = 0.25: parameter 'lambda' of law 'stvk' is too small for "
            "double precision, whose numbers keep their digits from 2.23e-308 to 1.8e+308");
  EXPECT_EQ(message(1e-310, 0).find(
                "young = 1e-310, poisson = 0: parameter 'mu' of law 'stvk' is too small"),
            0U);
  EXPECT_EQ(
      message(1e308, 0.4999)
          .find("young = 1e+308, poisson = 0.4999: parameter 'lambda' of law 'stvk' is too large"),
      0U);
}

TEST(CheckParameters, RefusesWhatIsNotFinite) {
  const Law law = law_with_range("");
  EXPECT_EQ(message_of<InputError>([&] { check_parameters(law, {NAN}); }),
            "k = nan: must be a finite number [Pa] for law 'own'");
  EXPECT_THROW(check_parameters(law, {}), InternalError);
}

}  // namespace
}  // namespace elastogen::symgen
