#include "symgen/dag/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/error.h"
#include "symgen/dag/decimal.h"

namespace elastogen::symgen {
namespace {

ExactNumber rational(long p, long q) { return ExactNumber(cln::cl_RA(p) / cln::cl_I(q)); }

TEST(ExactNumber, SquareRootsAreSimplified) {
  EXPECT_EQ(ExactNumber::square_root(12).text(), "2*sqrt(3)");
  EXPECT_EQ(ExactNumber::square_root(cln::cl_RA(3) / 5).text(), "1/5*sqrt(15)");
  EXPECT_TRUE(ExactNumber::square_root(cln::cl_RA(49) / 4) == rational(7, 2));
}

TEST(ExactNumber, ProductsOfRootsAreExact) {
  const ExactNumber a = ExactNumber::square_root(6), b = ExactNumber::square_root(10);
  EXPECT_EQ((a * b).text(), "2*sqrt(15)");
  EXPECT_TRUE(a * a == ExactNumber(6));
}

TEST(ExactNumber, EqualNumbersHaveEqualForm) {
  // (1 + sqrt 3)^2 = 4 + 2 sqrt 3
  const ExactNumber root = ExactNumber::square_root(3);
  EXPECT_TRUE((ExactNumber(1) + root).power(2) == ExactNumber(4) + ExactNumber(2) * root);
}

TEST(ExactNumber, InverseTimesNumberIsOne) {
  std::mt19937 generator(7);
  std::uniform_int_distribution<long> small(-5, 5);
  int checked = 0;
  for (int k = 0; k < 200; ++k) {
    const ExactNumber x = rational(small(generator), 7) +
                          ExactNumber(small(generator)) * ExactNumber::square_root(3) +
                          ExactNumber(small(generator)) * ExactNumber::square_root(5) +
                          rational(small(generator), 3) * ExactNumber::square_root(15);
    if (x.is_zero()) continue;
    EXPECT_TRUE(x * x.inverse() == ExactNumber(1)) << x.text();
    EXPECT_NEAR(x.to_double() * x.inverse().to_double(), 1.0, 1e-12) << x.text();
    ++checked;
  }
  EXPECT_GT(checked, 150);
}

TEST(ExactNumber, InverseOfZeroIsRefused) {
  EXPECT_THROW((void)ExactNumber(0).inverse(), InternalError);
}

TEST(NumberPool, EqualNumbersHaveOneId) {
  NumberPool pool;
  const NumberId root = pool.intern(ExactNumber::square_root(3));
  const NumberId third = pool.multiply(root, pool.inverse(pool.intern(ExactNumber(3))));
  EXPECT_EQ(pool.inverse(root), third);  // 1/sqrt 3 = sqrt 3 / 3
  EXPECT_EQ(pool.add(root, pool.negate(root)), NumberPool::zero);
  EXPECT_DOUBLE_EQ(pool.value(root), std::sqrt(3.0));
}

TEST(DecimalText, FortyDigits) {
  const cln::cl_F root =
      ExactNumber::square_root(cln::cl_RA(1) / 3).to_float(cln::float_format(60));
  EXPECT_EQ(decimal_text(root, 40), "0.5773502691896257645091487805019574556476");
  EXPECT_EQ(decimal_text(cln::cl_RA(-1) / 8, 4), "-0.1250");
  EXPECT_EQ(decimal_text(cln::cl_I(1234567), 3), "1.23e6");
  EXPECT_EQ(decimal_text(cln::cl_RA(999) / 1000, 2), "1.0");
  EXPECT_EQ(decimal_text(cln::cl_RA(1) / cln::expt_pos(cln::cl_I(10), 300), 3), "1.00e-300");
  EXPECT_EQ(decimal_text(cln::cl_I(0), 3), "0.000");
}

}  // namespace
}  // namespace elastogen::symgen
