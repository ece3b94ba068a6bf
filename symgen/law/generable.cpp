#include "symgen/law/generable.h"

#include <fmt/format.h>

#include <string>

#include "runtime/error.h"
#include "symgen/law/expression_text.h"

namespace elastogen::symgen {
namespace {

void check_number(const GiNaC::numeric& number) {
  static const GiNaC::numeric largest = GiNaC::numeric(10).power(100);
  const GiNaC::numeric size = GiNaC::abs(number);
  if (!size.is_zero() && (size > largest || size < largest.inverse())) {
    throw InputError(fmt::format(
        "number {} is outside 1e-100 ... 1e100, what kernels can compute with; change the unit",
        expression_text(number)));
  }
}

void check_power(const GiNaC::ex& power) {
  const GiNaC::ex &base = power.op(0), &exponent = power.op(1);
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("'{}': {}", expression_text(power), why));
  };
  if (!GiNaC::is_a<GiNaC::numeric>(exponent) ||
      !GiNaC::ex_to<GiNaC::numeric>(exponent).is_rational()) {
    fail(
        "an exponent must be a rational number, not a parameter: write the law once for each "
        "exponent that is needed");
  }
  const GiNaC::numeric value = GiNaC::ex_to<GiNaC::numeric>(exponent);
  if (GiNaC::abs(value.numer()) > 1000 || value.denom() > 64) {
    fail("an exponent p/q must have |p| <= 1000 and q <= 64");
  }
  if (value.is_integer()) return;
  if (!GiNaC::is_a<GiNaC::numeric>(base)) return;
  const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(base);
  if (!number.is_positive()) fail("a root must be of a positive number");
  if (number.numer() > 1000000 || number.denom() > 1000000) {
    fail(
        "a root must be of a number whose numerator and denominator are at most 1e6; make it a "
        "parameter");
  }
}

}  // namespace

void check_generable(const GiNaC::ex& term) {
  if (GiNaC::is_a<GiNaC::numeric>(term)) {
    check_number(GiNaC::ex_to<GiNaC::numeric>(term));
    return;
  }
  if (GiNaC::is_a<GiNaC::power>(term)) {
    check_power(term);
    check_generable(term.op(0));
    return;
  }
  for (const GiNaC::ex& operand : term) check_generable(operand);
}

}  // namespace elastogen::symgen
