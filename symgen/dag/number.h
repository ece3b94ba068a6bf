// Exact numbers: sums of rational multiples of square roots of integers.
#pragma once

#include <cln/cln.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace elastogen::symgen {

/// An element of a multi-quadratic field Q(sqrt d1, sqrt d2, ...): sum of r_i * sqrt(d_i) with
/// rational r_i != 0 and distinct square-free d_i >= 1 in ascending order. Square roots of distinct
/// square-free integers are linearly independent over the rationals, so this form is canonical:
/// equal numbers have equal terms. It holds every quadrature point that elastogen offers.
class ExactNumber {
 public:
  ExactNumber() = default;
  ExactNumber(long value) : ExactNumber(cln::cl_RA(value)) {}  // NOLINT: numbers read as numbers
  explicit ExactNumber(const cln::cl_RA& value);

  /// sqrt(value) for a rational value >= 0.
  [[nodiscard]] static ExactNumber square_root(const cln::cl_RA& value);

  [[nodiscard]] ExactNumber operator+(const ExactNumber& other) const;
  [[nodiscard]] ExactNumber operator*(const ExactNumber& other) const;
  [[nodiscard]] ExactNumber operator-() const;
  /// @throws InternalError  at zero
  [[nodiscard]] ExactNumber inverse() const;
  [[nodiscard]] ExactNumber power(long exponent) const;
  [[nodiscard]] bool operator==(const ExactNumber& other) const;

  [[nodiscard]] bool is_zero() const { return terms_.empty(); }
  [[nodiscard]] bool is_rational() const;
  /// @throws InternalError  unless is_rational()
  [[nodiscard]] cln::cl_RA rational() const;

  /// Value in a CLN floating-point format; correct to about one unit in the last place unless the
  /// terms cancel.
  [[nodiscard]] cln::cl_F to_float(cln::float_format_t format) const;
  [[nodiscard]] double to_double() const;  ///< nearest double
  [[nodiscard]] std::string text() const;  ///< "1/2 + 1/6*sqrt(3)"

 private:
  struct Term {
    long radicand;
    cln::cl_RA coefficient;
  };
  std::vector<Term> terms_;
};

/// Numbers by identity: equal numbers have equal ids, and arithmetic on ids is remembered, so that
/// passes compare and combine coefficients at the price of integers.
using NumberId = std::uint32_t;

class NumberPool {
 public:
  static constexpr NumberId zero = 0, one = 1, minus_one = 2;

  NumberPool();
  [[nodiscard]] NumberId intern(const ExactNumber& value);
  [[nodiscard]] const ExactNumber& exact(NumberId id) const { return values_[id]; }
  [[nodiscard]] double value(NumberId id) const { return doubles_[id]; }
  [[nodiscard]] NumberId add(NumberId a, NumberId b);
  [[nodiscard]] NumberId multiply(NumberId a, NumberId b);
  [[nodiscard]] NumberId inverse(NumberId a);
  [[nodiscard]] NumberId negate(NumberId a) { return multiply(a, minus_one); }
  /// The number without its sign.
  [[nodiscard]] NumberId size(NumberId a) { return value(a) < 0 ? negate(a) : a; }
  [[nodiscard]] NumberId power(NumberId a, long exponent);

 private:
  std::vector<ExactNumber> values_;
  std::vector<double> doubles_;
  std::unordered_multimap<double, NumberId> by_value_;
  std::unordered_map<std::uint64_t, NumberId> sums_, products_;
  std::unordered_map<NumberId, NumberId> inverses_;
};

}  // namespace elastogen::symgen
