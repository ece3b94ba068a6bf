#include "symgen/mechanics/functions.h"

#include <cln/cln.h>

#include <algorithm>

namespace elastogen::symgen {
namespace {

/// An exact argument is left symbolic; a floating-point one is evaluated at once, as GiNaC does
/// with its own functions.
bool is_inexact(const GiNaC::ex& x) {
  return GiNaC::is_a<GiNaC::numeric>(x) && !GiNaC::ex_to<GiNaC::numeric>(x).is_crational();
}

/// Decimal digits with which what is of second order in x, as a difference of what is of order
/// zero, still has all those of GiNaC::Digits: widened by twice the binary exponent of x.
std::size_t digits_for_second_order(const cln::cl_RA& x) {
  const cln::cl_F rounded = cln::cl_float(x, cln::float_format(17));
  const long small = std::max<long>(0, -static_cast<long>(cln::float_exponent(rounded)));
  // 10 guard digits; 2 * small bits are at most 0.61 * small decimal digits.
  return static_cast<std::size_t>(static_cast<long>(GiNaC::Digits) + 10 + (61 * small) / 100 + 1);
}

/// log(1 + x) for real x > -1, with so many digits that x - log(1 + x), which is about x^2/2,
/// still has all those of GiNaC::Digits: 1 + x is formed exactly.
cln::cl_F wide_log1p(const cln::cl_R& x) {
  const cln::cl_RA exact = cln::rational(x);
  return cln::ln(cln::cl_float(exact + 1, cln::float_format(digits_for_second_order(exact))));
}

GiNaC::ex to_working_precision(const cln::cl_F& value) {
  return GiNaC::numeric(
      cln::cl_float(value, cln::float_format(static_cast<std::size_t>(long(GiNaC::Digits)))));
}

bool has_real_logarithm(const GiNaC::ex& x) {
  return GiNaC::is_a<GiNaC::numeric>(x) && GiNaC::ex_to<GiNaC::numeric>(x).is_real() &&
         GiNaC::ex_to<GiNaC::numeric>(x) > -1 && !x.is_zero();
}

cln::cl_R real_value(const GiNaC::ex& x) {
  return cln::realpart(GiNaC::ex_to<GiNaC::numeric>(x).to_cl_N());
}

GiNaC::ex log1p_evalf(const GiNaC::ex& x) {
  if (x.is_zero()) return 0;
  if (has_real_logarithm(x)) return to_working_precision(wide_log1p(real_value(x)));
  if (GiNaC::is_a<GiNaC::numeric>(x)) return GiNaC::log(1 + x).evalf();
  return log1p(x).hold();
}

GiNaC::ex log1p_eval(const GiNaC::ex& x) {
  if (x.is_zero()) return 0;
  if (is_inexact(x)) return log1p_evalf(x);
  return log1p(x).hold();
}

GiNaC::ex log1p_derivative(const GiNaC::ex& x, unsigned /*argument*/) { return 1 / (1 + x); }

GiNaC::ex log1p_remainder_evalf(const GiNaC::ex& x) {
  if (x.is_zero()) return 0;
  if (has_real_logarithm(x)) {
    const cln::cl_F logarithm = wide_log1p(real_value(x));
    const cln::cl_F wide_x =
        cln::cl_float(cln::rational(real_value(x)), cln::float_format(logarithm));
    return to_working_precision(wide_x - logarithm);
  }
  if (GiNaC::is_a<GiNaC::numeric>(x)) return x - GiNaC::log(1 + x).evalf();
  return log1p_remainder(x).hold();
}

GiNaC::ex log1p_remainder_eval(const GiNaC::ex& x) {
  if (x.is_zero()) return 0;
  if (is_inexact(x)) return log1p_remainder_evalf(x);
  return log1p_remainder(x).hold();
}

GiNaC::ex log1p_remainder_derivative(const GiNaC::ex& x, unsigned /*argument*/) {
  return x / (1 + x);
}

GiNaC::ex expm1_remainder_evalf(const GiNaC::ex& y) {
  if (y.is_zero()) return 0;
  if (!GiNaC::is_a<GiNaC::numeric>(y)) return expm1_remainder(y).hold();
  if (!GiNaC::ex_to<GiNaC::numeric>(y).is_real()) return (GiNaC::exp(y) - 1 - y).evalf();
  // As many more digits as the difference loses, twice those of y.
  const cln::cl_RA exact = cln::rational(real_value(y));
  const cln::cl_F wide = cln::cl_float(exact, cln::float_format(digits_for_second_order(exact)));
  return to_working_precision(cln::exp(wide) - 1 - wide);
}

GiNaC::ex expm1_remainder_eval(const GiNaC::ex& y) {
  if (y.is_zero()) return 0;
  if (is_inexact(y)) return expm1_remainder_evalf(y);
  return expm1_remainder(y).hold();
}

GiNaC::ex expm1_remainder_derivative(const GiNaC::ex& y, unsigned /*argument*/) {
  return y + expm1_remainder(y);
}

GiNaC::ex negative_part_evalf(const GiNaC::ex& x) {
  if (!GiNaC::is_a<GiNaC::numeric>(x)) return negative_part(x).hold();
  return GiNaC::ex_to<GiNaC::numeric>(x).is_negative() ? -x : GiNaC::ex(0);
}

GiNaC::ex negative_part_eval(const GiNaC::ex& x) {
  return GiNaC::is_a<GiNaC::numeric>(x) ? negative_part_evalf(x) : negative_part(x).hold();
}

}  // namespace

REGISTER_FUNCTION(negative_part, eval_func(negative_part_eval).evalf_func(negative_part_evalf))
REGISTER_FUNCTION(expm1_remainder, eval_func(expm1_remainder_eval)
                                       .evalf_func(expm1_remainder_evalf)
                                       .derivative_func(expm1_remainder_derivative)
                                       .latex_name("\\operatorname{expm1r}"))
REGISTER_FUNCTION(log1p, eval_func(log1p_eval)
                             .evalf_func(log1p_evalf)
                             .derivative_func(log1p_derivative)
                             .latex_name("\\operatorname{log1p}"))
REGISTER_FUNCTION(log1p_remainder, eval_func(log1p_remainder_eval)
                                       .evalf_func(log1p_remainder_evalf)
                                       .derivative_func(log1p_remainder_derivative)
                                       .latex_name("\\operatorname{log1pr}"))

}  // namespace elastogen::symgen
