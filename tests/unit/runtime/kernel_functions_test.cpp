// Elementary functions of kernels: error in units in the last place against long double, on scalars
// and packs, and what comes out where they are not defined.
#include "runtime/kernel_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace elastogen::kernel {
namespace {

long double exact_log1p_remainder(long double x) {
  if (std::abs(x) >= 0.1L) return x - std::log1p(x);
  long double sum = 0, power = x;
  for (int n = 2; n <= 40; ++n) {
    power *= -x;
    sum -= power / n;
  }
  return sum;
}

long double exact_expm1_remainder(long double y) {
  if (std::abs(y) >= 0.5L) return std::exp(y) - 1 - y;
  long double sum = 0, term = y;
  for (int n = 2; n <= 30; ++n) {
    term *= y / n;
    sum += term;
  }
  return sum;
}

template <class V>
using FunctionOf = V (*)(const V&);
using Exact = long double (*)(long double);

/// Greatest error in ulp of the exact value at random arguments: uniform ones in [low, high], and
/// those of either sign that are spread over all orders of magnitude down to 1e-18.
template <class V>
double worst_error(FunctionOf<V> function, Exact exact, double low, double high) {
  using S = Scalar<V>;
  constexpr int lanes = static_cast<int>(sizeof(V) / sizeof(S));
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(low, high), exponent(-18, 0);
  double worst = 0;
  for (int n = 0; n < 40000 / lanes; ++n) {
    S arguments[lanes], values[lanes];
    for (int l = 0; l < lanes; ++l) {
      const double scale = n % 2 == 0              ? uniform(generator)
                           : n % 4 == 1 && low < 0 ? low * std::pow(10, exponent(generator))
                                                   : high * std::pow(10, exponent(generator));
      arguments[l] = static_cast<S>(scale);
    }
    if constexpr (lanes == 1) {
      values[0] = function(arguments[0]);
    } else {
      V pack{};
      for (int l = 0; l < lanes; ++l) pack[l] = arguments[l];
      pack = function(pack);
      for (int l = 0; l < lanes; ++l) values[l] = pack[l];
    }
    for (int l = 0; l < lanes; ++l) {
      const long double expected = exact(arguments[l]);
      const S size = std::abs(static_cast<S>(expected));
      const double ulp = std::nextafter(size, std::numeric_limits<S>::infinity()) - size;
      const double error = static_cast<double>(std::abs(values[l] - expected)) / ulp;
      if (!(error <= worst)) worst = error;  // also what is not a number
    }
  }
  return worst;
}

template <class V>
class Functions : public testing::Test {};
using Packs = testing::Types<double, float, Pack<double, 4>, Pack<double, 8>, Pack<float, 16>>;
TYPED_TEST_SUITE(Functions, Packs);

TYPED_TEST(Functions, StayWithinTheirBounds) {
  using V = TypeParam;
  EXPECT_LT(worst_error<V>(
                &log1p<V>, [](long double x) { return std::log1p(x); }, -0.999, 50),
            1.5);
  EXPECT_LT(worst_error<V>(&log1p_remainder<V>, &exact_log1p_remainder, -0.999, 50), 3);
  EXPECT_LT(worst_error<V>(&log1p_remainder<V>, &exact_log1p_remainder, 0.3, 0.6), 3);
  EXPECT_LT(worst_error<V>(
                &log<V>, [](long double x) { return std::log(x); }, 1e-9, 1e9),
            1.5);
  EXPECT_LT(worst_error<V>(&expm1_remainder<V>, &exact_expm1_remainder, -80, 80), 2.5);
  EXPECT_LT(worst_error<V>(&expm1_remainder<V>, &exact_expm1_remainder, -1, 1), 2.5);
  EXPECT_LT(worst_error<V>(
                &kernel::exp<V>, [](long double x) { return std::exp(x); }, -80, 80),
            1.5);
}

template <class V>
Scalar<V> at(FunctionOf<V> function, Scalar<V> argument) {
  if constexpr (std::is_floating_point_v<V>) {
    return function(argument);
  } else {
    return function(V{} + argument)[1];
  }
}

TYPED_TEST(Functions, AreExactAtZeroAndNotANumberOutsideTheirDomain) {
  using V = TypeParam;
  using S = Scalar<V>;
  constexpr S infinity = std::numeric_limits<S>::infinity();
  constexpr S nan = std::numeric_limits<S>::quiet_NaN();
  EXPECT_EQ(at<V>(&log1p<V>, 0), 0);
  EXPECT_EQ(at<V>(&log1p_remainder<V>, 0), 0);
  EXPECT_EQ(at<V>(&expm1_remainder<V>, 0), 0);
  EXPECT_EQ(at<V>(&log<V>, 1), 0);
  EXPECT_EQ(at<V>(&kernel::exp<V>, 0), 1);
  for (const S x : {S(-1), S(-1.5), S(-1e10), nan, -infinity}) {
    EXPECT_TRUE(std::isnan(at<V>(&log1p<V>, x))) << x;
    EXPECT_TRUE(std::isnan(at<V>(&log1p_remainder<V>, x))) << x;
  }
  for (const S x : {S(0), S(-1), nan, -infinity}) EXPECT_TRUE(std::isnan(at<V>(&log<V>, x))) << x;
  EXPECT_FALSE(std::isfinite(at<V>(&log1p<V>, infinity)));
  EXPECT_FALSE(std::isfinite(at<V>(&log1p_remainder<V>, infinity)));
  EXPECT_EQ(at<V>(&kernel::exp<V>, S(1000)), infinity);
  EXPECT_EQ(at<V>(&kernel::exp<V>, S(-1000)), 0);
  EXPECT_EQ(at<V>(&kernel::exp<V>, infinity), infinity);
  EXPECT_EQ(at<V>(&expm1_remainder<V>, S(1000)), infinity);
  EXPECT_EQ(at<V>(&expm1_remainder<V>, S(-1000)), 999);
  EXPECT_TRUE(std::isnan(at<V>(&kernel::exp<V>, nan)));
  EXPECT_TRUE(std::isnan(at<V>(&expm1_remainder<V>, nan)));
}

// Logarithms take a shorter way where all lanes are near 1: a lane's result is the same either way.
TYPED_TEST(Functions, LanesDoNotDependOnEachOther) {
  using V = TypeParam;
  using S = Scalar<V>;
  constexpr int lanes = static_cast<int>(sizeof(V) / sizeof(S));
  if constexpr (lanes > 1) {
    for (const FunctionOf<V> function : {&log1p<V>, &log1p_remainder<V>, &kernel::log<V>}) {
      for (const S near : {S(1e-12), S(-0.28), S(0.3), S(0.4)}) {
        V alone, mixed;
        for (int l = 0; l < lanes; ++l) alone[l] = mixed[l] = near;
        mixed[lanes - 1] = S(7);
        const V expected = function(alone), result = function(mixed);
        for (int l = 0; l + 1 < lanes; ++l) {
          if (near < 0 && function == &kernel::log<V>) continue;  // not a number
          EXPECT_EQ(result[l], expected[l]) << near;
        }
      }
    }
  }
}

}  // namespace
}  // namespace elastogen::kernel
