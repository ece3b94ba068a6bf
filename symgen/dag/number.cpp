#include "symgen/dag/number.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

/// value = square^2 * free, free square-free; value > 0.
struct SquareFree {
  cln::cl_I square = 1;
  long free = 1;
};

SquareFree square_free_part(cln::cl_I value) {
  SquareFree result;
  for (long p = 2; cln::cl_I(p) * p <= value; ++p) {
    int exponent = 0;
    while (cln::zerop(cln::mod(value, p))) {
      value = cln::exquo(value, p);
      ++exponent;
    }
    result.square = result.square * cln::expt_pos(cln::cl_I(p), exponent / 2 + 1);
    result.square = cln::exquo(result.square, p);
    if (exponent % 2 == 1) result.free *= p;
  }
  result.free *= cln::cl_I_to_long(value);
  return result;
}

}  // namespace

ExactNumber::ExactNumber(const cln::cl_RA& value) {
  if (!cln::zerop(value)) terms_.push_back({1, value});
}

ExactNumber ExactNumber::square_root(const cln::cl_RA& value) {
  if (cln::minusp(value)) throw InternalError("square root of a negative number");
  ExactNumber result;
  if (cln::zerop(value)) return result;
  // sqrt(p/q) = sqrt(p q) / q
  const cln::cl_I p = cln::numerator(value), q = cln::denominator(value);
  const SquareFree part = square_free_part(p * q);
  result.terms_.push_back({part.free, part.square / q});
  return result;
}

ExactNumber ExactNumber::operator+(const ExactNumber& other) const {
  ExactNumber result;
  auto a = terms_.begin();
  auto b = other.terms_.begin();
  while (a != terms_.end() || b != other.terms_.end()) {
    if (b == other.terms_.end() || (a != terms_.end() && a->radicand < b->radicand)) {
      result.terms_.push_back(*a++);
    } else if (a == terms_.end() || b->radicand < a->radicand) {
      result.terms_.push_back(*b++);
    } else {
      const cln::cl_RA sum = a->coefficient + b->coefficient;
      if (!cln::zerop(sum)) result.terms_.push_back({a->radicand, sum});
      ++a;
      ++b;
    }
  }
  return result;
}

ExactNumber ExactNumber::operator*(const ExactNumber& other) const {
  ExactNumber result;
  for (const Term& a : terms_) {
    for (const Term& b : other.terms_) {
      // sqrt(a) sqrt(b) = g sqrt((a/g) (b/g)) with g = gcd(a, b); square-free again
      const long g = std::gcd(a.radicand, b.radicand);
      ExactNumber product;
      product.terms_.push_back(
          {(a.radicand / g) * (b.radicand / g), a.coefficient * b.coefficient * g});
      result = result + product;
    }
  }
  return result;
}

ExactNumber ExactNumber::operator-() const { return *this * ExactNumber(-1); }

ExactNumber ExactNumber::inverse() const {
  if (is_zero()) throw InternalError("division by an exact zero");
  // Multiply numerator and denominator by the conjugate in one prime after the other until the
  // denominator is rational.
  ExactNumber numerator(1), denominator = *this;
  while (!denominator.is_rational()) {
    long radicand = denominator.terms_.back().radicand;
    long prime = 2;
    while (radicand % prime != 0) ++prime;
    ExactNumber conjugate = denominator;
    for (Term& term : conjugate.terms_) {
      if (term.radicand % prime == 0) term.coefficient = -term.coefficient;
    }
    numerator = numerator * conjugate;
    denominator = denominator * conjugate;
  }
  return numerator * ExactNumber(1 / denominator.rational());
}

ExactNumber ExactNumber::power(long exponent) const {
  ExactNumber base = exponent < 0 ? inverse() : *this;
  ExactNumber result(1);
  for (long n = std::labs(exponent); n > 0; n /= 2) {
    if (n % 2 == 1) result = result * base;
    base = base * base;
  }
  return result;
}

bool ExactNumber::operator==(const ExactNumber& other) const {
  return std::equal(terms_.begin(), terms_.end(), other.terms_.begin(), other.terms_.end(),
                    [](const Term& a, const Term& b) {
                      return a.radicand == b.radicand && a.coefficient == b.coefficient;
                    });
}

bool ExactNumber::is_rational() const {
  return terms_.empty() || (terms_.size() == 1 && terms_[0].radicand == 1);
}

cln::cl_RA ExactNumber::rational() const {
  if (!is_rational()) throw InternalError("exact number " + text() + " is not rational");
  return terms_.empty() ? cln::cl_RA(0) : terms_[0].coefficient;
}

cln::cl_F ExactNumber::to_float(cln::float_format_t format) const {
  cln::cl_F sum = cln::cl_float(cln::cl_I(0), format);
  for (const Term& term : terms_) {
    sum = sum + cln::cl_float(term.coefficient, format) *
                    cln::sqrt(cln::cl_float(cln::cl_I(term.radicand), format));
  }
  return sum;
}

double ExactNumber::to_double() const {
  return is_rational() ? cln::double_approx(rational())
                       : cln::double_approx(to_float(cln::float_format(50)));
}

std::string ExactNumber::text() const {
  if (terms_.empty()) return "0";
  std::ostringstream out;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    const bool negative = cln::minusp(term.coefficient);
    if (i > 0) {
      out << (negative ? " - " : " + ");
    } else if (negative) {
      out << "-";
    }
    const cln::cl_RA magnitude = cln::abs(term.coefficient);
    if (term.radicand == 1) {
      out << magnitude;
    } else {
      if (magnitude != 1) out << magnitude << "*";
      out << "sqrt(" << term.radicand << ")";
    }
  }
  return out.str();
}

NumberPool::NumberPool() {
  (void)intern(ExactNumber(0));
  (void)intern(ExactNumber(1));
  (void)intern(ExactNumber(-1));
}

NumberId NumberPool::intern(const ExactNumber& value) {
  const double approximate = value.to_double();
  const auto [first, last] = by_value_.equal_range(approximate);
  for (auto it = first; it != last; ++it) {
    if (values_[it->second] == value) return it->second;
  }
  const NumberId id = static_cast<NumberId>(values_.size());
  values_.push_back(value);
  doubles_.push_back(approximate);
  by_value_.emplace(approximate, id);
  return id;
}

namespace {
std::uint64_t pair_key(NumberId a, NumberId b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}
}  // namespace

NumberId NumberPool::add(NumberId a, NumberId b) {
  if (a == zero) return b;
  if (b == zero) return a;
  const auto [it, is_new] = sums_.try_emplace(pair_key(a, b), zero);
  if (is_new) it->second = intern(values_[a] + values_[b]);
  return it->second;
}

NumberId NumberPool::multiply(NumberId a, NumberId b) {
  if (a == one) return b;
  if (b == one) return a;
  if (a == zero || b == zero) return zero;
  const auto [it, is_new] = products_.try_emplace(pair_key(a, b), zero);
  if (is_new) it->second = intern(values_[a] * values_[b]);
  return it->second;
}

NumberId NumberPool::inverse(NumberId a) {
  const auto [it, is_new] = inverses_.try_emplace(a, zero);
  if (is_new) it->second = intern(values_[a].inverse());
  return it->second;
}

NumberId NumberPool::power(NumberId a, long exponent) {
  if (exponent == 1) return a;
  if (exponent == -1) return inverse(a);
  return intern(values_[a].power(exponent));
}

}  // namespace elastogen::symgen
