#include "symgen/mechanics/functions.h"

#include <gtest/gtest.h>

#include "tests/unit/symgen/relative_error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// Sets GiNaC's digits for the length of a test.
class Precision {
 public:
  explicit Precision(long digits) : before_(long(GiNaC::Digits)) { GiNaC::Digits = digits; }
  ~Precision() { GiNaC::Digits = before_; }

 private:
  long before_;
};

numeric value_of(const ex& expression) { return GiNaC::ex_to<numeric>(expression.evalf()); }

numeric power_of_ten(int n) { return numeric(10).power(numeric(n)); }

TEST(Log1p, VanishesAtZeroAndStaysSymbolicAtExactArguments) {
  EXPECT_TRUE(ex(log1p(ex(0))).is_zero());
  EXPECT_TRUE(ex(log1p_remainder(ex(0))).is_zero());
  EXPECT_TRUE(GiNaC::is_the_function<log1p_SERIAL>(log1p(ex(numeric(1, 3)))));
  EXPECT_TRUE(GiNaC::is_the_function<log1p_remainder_SERIAL>(log1p_remainder(ex(numeric(1, 3)))));
}

TEST(Log1p, AgreesWithLogarithmWhereThatIsAccurate) {
  const Precision precision(60);
  for (const numeric& x : {numeric(1, 2), numeric(-9, 10), numeric(7), numeric(1, 100)}) {
    const numeric logarithm = value_of(GiNaC::log(ex(1 + x)));
    EXPECT_LT(relative_error(value_of(log1p(ex(x))), logarithm), 1e-58) << x;
    EXPECT_LT(relative_error(value_of(log1p_remainder(ex(x))), x - logarithm), 1e-56) << x;
  }
}

TEST(Log1p, KeepsAllDigitsAtTinyArguments) {
  const Precision precision(60);
  for (const int exponent : {-10, -40, -200}) {
    const numeric x = 3 * power_of_ten(exponent);
    // Taylor series; the first term left out is x^9, far below 60 digits only for small x.
    numeric series = 0, remainder = 0;
    for (int n = 1; n <= 12; ++n) {
      const numeric term = x.power(numeric(n)) / n * (n % 2 == 1 ? 1 : -1);
      series += term;
      if (n >= 2) remainder -= term;
    }
    EXPECT_LT(relative_error(value_of(log1p(ex(x))), series), 1e-58) << exponent;
    EXPECT_LT(relative_error(value_of(log1p_remainder(ex(x))), remainder), 1e-58) << exponent;
  }
}

TEST(Log1p, DerivativesAreThoseOfTheDefinition) {
  const GiNaC::symbol x("x");
  const ex argument = x * x;
  EXPECT_TRUE((log1p(argument).diff(x) - GiNaC::log(1 + argument).diff(x)).normal().is_zero());
  EXPECT_TRUE((log1p_remainder(argument).diff(x) - (argument - GiNaC::log(1 + argument)).diff(x))
                  .normal()
                  .is_zero());
}

TEST(Log1p, EvaluatesFloatingPointArgumentsAtOnce) {
  const ex value = log1p(ex(0.5));
  ASSERT_TRUE(GiNaC::is_a<numeric>(value));
  EXPECT_NEAR(GiNaC::ex_to<numeric>(value).to_double(), 0.405465108108164, 1e-15);
}

TEST(Log1p, IsComplexBelowMinusOne) {
  const numeric value = value_of(log1p(ex(-3)));
  EXPECT_NEAR(value.real().to_double(), 0.693147180559945, 1e-14);
  EXPECT_NEAR(value.imag().to_double(), 3.141592653589793, 1e-14);
}

}  // namespace
}  // namespace elastogen::symgen
