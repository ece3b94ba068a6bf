#include "symgen/dag/decimal.h"

#include <fmt/format.h>

#include <sstream>

namespace elastogen::symgen {
namespace {

/// Nearest integer to |value| * 10^exponent, exactly rounded.
cln::cl_I scaled(const cln::cl_R& value, long exponent) {
  const cln::cl_RA exact = cln::rational(cln::abs(value));
  return cln::round1(exact * cln::expt(cln::cl_RA(10), exponent));
}

}  // namespace

std::string decimal_text(const cln::cl_R& number, int digits) {
  if (cln::zerop(number)) return "0." + std::string(static_cast<std::size_t>(digits), '0');
  const cln::cl_I limit = cln::expt_pos(cln::cl_I(10), digits);
  // The exponent of the first digit: from the binary exponent, then corrected.
  const cln::cl_F rough = cln::cl_float(cln::abs(number), cln::float_format(20));
  long exponent = static_cast<long>(
      static_cast<double>(cln::float_exponent(rough)) * 0.30102999566398120 - 1.0);
  while (scaled(number, digits - 1 - exponent) >= limit) ++exponent;
  while (scaled(number, digits - 1 - exponent) * 10 < limit) --exponent;

  std::ostringstream stream;
  stream << scaled(number, digits - 1 - exponent);
  const std::string mantissa = stream.str();
  const std::string sign = cln::minusp(number) ? "-" : "";
  if (exponent < -5 || exponent >= digits) {
    return fmt::format("{}{}.{}e{}", sign, mantissa.substr(0, 1), mantissa.substr(1), exponent);
  }
  if (exponent < 0) {
    return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + mantissa;
  }
  const auto whole = static_cast<std::size_t>(exponent + 1);
  const std::string fraction = mantissa.substr(whole);
  return sign + mantissa.substr(0, whole) + (fraction.empty() ? "" : "." + fraction);
}

}  // namespace elastogen::symgen
