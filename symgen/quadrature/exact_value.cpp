#include "symgen/quadrature/exact_value.h"

#include <sstream>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

cln::cl_RA rational_value(const GiNaC::numeric& value) {
  return cln::the<cln::cl_RA>(value.to_cl_N());
}

}  // namespace

ExactNumber exact_value(const GiNaC::ex& expression) {
  if (GiNaC::is_a<GiNaC::numeric>(expression)) {
    const auto& value = GiNaC::ex_to<GiNaC::numeric>(expression);
    if (value.is_rational()) return ExactNumber(rational_value(value));
  } else if (GiNaC::is_a<GiNaC::add>(expression)) {
    ExactNumber sum(0);
    for (const GiNaC::ex& operand : expression) sum = sum + exact_value(operand);
    return sum;
  } else if (GiNaC::is_a<GiNaC::mul>(expression)) {
    ExactNumber product(1);
    for (const GiNaC::ex& operand : expression) product = product * exact_value(operand);
    return product;
  } else if (GiNaC::is_a<GiNaC::power>(expression) &&
             GiNaC::is_a<GiNaC::numeric>(expression.op(1))) {
    const auto& exponent = GiNaC::ex_to<GiNaC::numeric>(expression.op(1));
    const ExactNumber base = exact_value(expression.op(0));
    if (exponent.is_integer()) return base.power(exponent.to_long());
    if ((2 * exponent).is_integer() && base.is_rational()) {
      return ExactNumber::square_root(base.rational()).power((2 * exponent).to_long());
    }
  }
  std::ostringstream message;
  message << "no sum of rational multiples of square roots: " << expression;
  throw InternalError(message.str());
}

}  // namespace elastogen::symgen
