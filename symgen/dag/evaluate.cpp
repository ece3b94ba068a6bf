#include "symgen/dag/evaluate.h"

#include "runtime/kernel_support.h"

namespace elastogen::symgen {

cln::cl_RA exact_value(double value) {
  if (!std::isfinite(value)) {
    throw InputError("exact evaluation takes finite numbers only, found " + std::to_string(value));
  }
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const cln::cl_I mantissa(static_cast<long>(std::ldexp(fraction, 53)));
  return mantissa * cln::expt(cln::cl_RA(2), exponent - 53);
}

double DoubleArithmetic::power(double base, const cln::cl_RA& exponent) const {
  return std::pow(base, cln::double_approx(exponent));
}

double DoubleArithmetic::apply(Function function, double x) const {
  switch (function) {
    case Function::log:
      return std::log(x);
    case Function::log1p:
      return std::log1p(x);
    case Function::log1p_remainder:
      return kernel::log1p_remainder(x);
    case Function::exp:
      return std::exp(x);
    case Function::expm1_remainder:
      return kernel::expm1_remainder(x);
    case Function::negative_part:
      return kernel::negative_part(x);
    case Function::none:
      break;
  }
  throw InternalError("unknown function in the expression graph");
}

cln::cl_R ClnArithmetic::from_exact(const ExactNumber& value) const {
  if (value.is_rational()) return value.rational();
  return value.to_float(format_);
}

cln::cl_R ClnArithmetic::from_double(double value) const {
  return cln::cl_float(exact_value(value), format_);
}

cln::cl_R ClnArithmetic::power(const Number& base, const cln::cl_RA& exponent) const {
  if (cln::zerop(base) && cln::minusp(exponent)) {
    throw OutsideDomain("outside the law's domain: division by zero");
  }
  if (cln::denominator(exponent) == 1) return cln::expt(base, cln::numerator(exponent));
  if (cln::minusp(base)) {
    throw OutsideDomain("outside the law's domain: root of a negative number");
  }
  const cln::cl_F x = cln::cl_float(base, format_);
  if (cln::zerop(x)) return cln::cl_I(0);
  return cln::exp(cln::ln(x) * exponent);
}

cln::cl_R ClnArithmetic::apply(Function function, const Number& x) const {
  // Remainders and log1p cancel near zero: more digits there. CLN rounds mixed operations to the
  // shorter operand, so both must be wide.
  const cln::float_format_t wide = cln::float_format(3 * digits_);
  const auto logarithm = [&](const Number& argument) -> cln::cl_R {
    if (!cln::plusp(argument)) {
      throw OutsideDomain("outside the law's domain: logarithm of a number that is not positive");
    }
    return cln::ln(cln::cl_float(argument, wide));
  };
  switch (function) {
    case Function::log:
      return cln::cl_float(logarithm(x), format_);
    case Function::log1p:
      return cln::cl_float(logarithm(1 + cln::cl_float(x, wide)), format_);
    case Function::log1p_remainder:
      return cln::cl_float(cln::cl_float(x, wide) - logarithm(1 + cln::cl_float(x, wide)), format_);
    case Function::exp:
      return cln::exp(cln::cl_float(x, format_));
    case Function::expm1_remainder: {
      const cln::cl_F wide_x = cln::cl_float(x, wide);
      return cln::cl_float(cln::exp(wide_x) - 1 - wide_x, format_);
    }
    case Function::negative_part:
      return cln::minusp(x) ? -x : cln::cl_R(0);
    case Function::none:
      break;
  }
  throw InternalError("unknown function in the expression graph");
}

}  // namespace elastogen::symgen
