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

/// log(1 + x) for real x > -1, with so many digits that x - log(1 + x), which is about x^2/2,
/// still has all those of GiNaC::Digits: 1 + x is formed exactly, and the format is widened by
/// twice the binary exponent of x.
cln::cl_F wide_log1p(const cln::cl_R& x) {
  const cln::cl_RA exact = cln::rational(x);
  const cln::cl_F rounded = cln::cl_float(exact, cln::float_format(17));
  const long small = std::max<long>(0, -static_cast<long>(cln::float_exponent(rounded)));
  // 10 guard digits; 2 * small bits are at most 0.61 * small decimal digits.
  const long digits = static_cast<long>(GiNaC::Digits) + 10 + (61 * small) / 100 + 1;
  return cln::ln(cln::cl_float(exact + 1, cln::float_format(static_cast<std::size_t>(digits))));
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

}  // namespace

REGISTER_FUNCTION(log1p, eval_func(log1p_eval)
                             .evalf_func(log1p_evalf)
                             .derivative_func(log1p_derivative)
                             .latex_name("\\operatorname{log1p}"))
REGISTER_FUNCTION(log1p_remainder, eval_func(log1p_remainder_eval)
                                       .evalf_func(log1p_remainder_evalf)
                                       .derivative_func(log1p_remainder_derivative)
                                       .latex_name("\\operatorname{log1pr}"))

}  // namespace elastogen::symgen
