#include "symgen/law/expression_text.h"

#include <gtest/gtest.h>

namespace elastogen::symgen {
namespace {

/// Text that GiNaC's parser reads back as the same expression.
void expect_round_trip(const GiNaC::ex& expression, const GiNaC::symtab& symbols) {
  GiNaC::parser reader(symbols, /*strict=*/true);
  const std::string text = expression_text(expression);
  EXPECT_TRUE((reader(text) - expression).expand().normal().is_zero()) << text;
}

TEST(ExpressionText, ReadsBackAsTheSameExpression) {
  const GiNaC::symbol x("x"), y("y");
  const GiNaC::symtab symbols = {{"x", x}, {"y", y}};
  expect_round_trip(GiNaC::numeric(1, 8) * (1 - x) * (1 + y), symbols);
  expect_round_trip(-x - y - 3, symbols);
  expect_round_trip(-x / (1 - y), symbols);
  expect_round_trip(1 / (x * x), symbols);
  expect_round_trip(pow(x - y, 2) * GiNaC::sqrt(GiNaC::ex(3)) / 2, symbols);
  expect_round_trip(pow(x, -y) + log(1 + x), symbols);
}

TEST(ExpressionText, OrdersOperandsByName) {
  const GiNaC::symbol x("x"), y("y"), z("z");
  EXPECT_EQ(expression_text(z + y + x), "x + y + z");
  EXPECT_EQ(expression_text(x - z * y), "x - y*z");
  EXPECT_EQ(expression_text((1 - y) * (1 - x) / 4), "1/4*(1 - x)*(1 - y)");
  EXPECT_EQ(expression_text(1 / (1 - x)), "1/(1 - x)");
}

}  // namespace
}  // namespace elastogen::symgen
