#include "symgen/law/expression.h"

#include <gtest/gtest.h>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

const GiNaC::symbol a("a"), b("b");

ex parse(const std::string& text) {
  return parse_expression(text, {{"parameters", {{"a", a}, {"b", b}}}});
}

std::string error_of(const std::string& text) {
  try {
    (void)parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "'" << text << "' was accepted";
  return "";
}

TEST(ParseExpression, ReadsArithmetic) {
  EXPECT_TRUE(parse("a*b + 2/3").is_equal(a * b + numeric(2, 3)));
  EXPECT_TRUE(parse("-a^2*b").is_equal(-GiNaC::pow(a, 2) * b));
  EXPECT_TRUE(parse("a/b/a").is_equal(1 / b));
  EXPECT_TRUE(parse("a - b - a").is_equal(-b));
  EXPECT_TRUE(parse("a^(-2/3)").is_equal(GiNaC::pow(a, numeric(-2, 3))));
  EXPECT_TRUE(parse("(a^2)^b").is_equal(GiNaC::pow(GiNaC::pow(a, 2), b)));
  EXPECT_TRUE(parse("log(a) + sqrt(b)*exp(-a)")
                  .is_equal(GiNaC::log(a) + GiNaC::sqrt(ex(b)) * GiNaC::exp(-a)));
  EXPECT_TRUE(parse(" \ta\n+\nb ").is_equal(a + b));
}

TEST(ParseExpression, TakesDecimalsExactly) {
  EXPECT_TRUE(parse("0.1").is_equal(numeric(1, 10)));
  EXPECT_TRUE(parse("2.5e-3*a").is_equal(numeric(1, 400) * a));
  EXPECT_TRUE(parse("a^.5").is_equal(GiNaC::sqrt(ex(a))));
  EXPECT_TRUE(parse("1E3 + 2.").is_equal(ex(1002)));
}

struct BadExpression {
  const char *name, *text, *message;
};

class ParseExpressionError : public testing::TestWithParam<BadExpression> {};

TEST_P(ParseExpressionError, IsExplained) {
  EXPECT_NE(error_of(GetParam().text).find(GetParam().message), std::string::npos)
      << error_of(GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Texts, ParseExpressionError,
    testing::Values(
        BadExpression{"Empty", " ", "is empty"},
        BadExpression{"UnknownSymbol", "a*c",
                      "\"a*c\": unknown symbol 'c' at column 3; did you mean 'a'?; allowed are "
                      "parameters a, b; functions log, sqrt, exp"},
        BadExpression{"UnknownFunction", "sqr(a)", "'sqr' is no function; did you mean 'sqrt'?"},
        BadExpression{"SymbolCalled", "a(b)", "'a' is no function"},
        BadExpression{"FunctionWithoutArgument", "log*a", "'log' needs an argument"},
        BadExpression{"EmptyArgument", "log()", "a number or a symbol is missing before ')'"},
        BadExpression{"EndsEarly", "a +", "ends where a number or a symbol is missing"},
        BadExpression{"StartsWithOperator", "*a", "missing before '*'"},
        BadExpression{"OperatorMissing", "a b", "column 3: an operator is missing before 'b'"},
        BadExpression{"ImplicitProduct", "2a", "an operator is missing before 'a'"},
        BadExpression{"OpenParenthesis", "(a + (b", "2 closing ')' missing"},
        BadExpression{"CloseParenthesis", "a)", "')' without '('"},
        BadExpression{"SignAfterOperator", "2^-a*b", "put it in parentheses, as in ^(-2)"},
        BadExpression{"PowerOfPower", "a^b^2", "ambiguous"},
        BadExpression{"StrangeCharacter", "a & b", "column 3: '&' cannot stand here"},
        BadExpression{"GreekLetter", "a*λ", "column 3: 'λ' cannot stand here"},
        BadExpression{"GreekLetterIsSpelt", "a*λ", "; write lambda for it"},
        BadExpression{"RaisedDigit", "a²", "column 2: '²' cannot stand here"},
        BadExpression{"LetterOfFourBytes", "a + 𝜇*b", "column 5: '𝜇' cannot stand here"},
        BadExpression{"HalfALetter", "a*\xce", "column 3: '\\xce' cannot stand here"},
        BadExpression{"ControlCharacter", "a*\x07", "column 3: '\\x07' cannot stand here"},
        BadExpression{"TwoArguments", "log(a, b)", "',' cannot stand here"},
        BadExpression{"DivisionByZero", "a/(b - b)", "divides by zero"},
        BadExpression{"NotReal", "a*sqrt(-4)", "is not real"},
        BadExpression{"HugeExponent", "1e401*a", "exponents must be within"}),
    [](const auto& bad) { return bad.param.name; });

TEST(ExactDecimal, ReadsWhatIsWritten) {
  EXPECT_EQ(exact_decimal("-2.5e-3"), numeric(-1, 400));
  EXPECT_EQ(exact_decimal("0.4999"), numeric(4999, 10000));
  EXPECT_EQ(exact_decimal("1e+2"), numeric(100));
  EXPECT_THROW((void)exact_decimal("nan"), InputError);
  EXPECT_THROW((void)exact_decimal(""), InputError);
  EXPECT_THROW((void)exact_decimal("1.5x"), InputError);
}

TEST(WithoutSpaces, IsTheSameForTheSameExpression) {
  EXPECT_EQ(without_spaces(" mu / 2*( I1-3 )\n"), "mu/2*(I1-3)");
}

}  // namespace
}  // namespace elastogen::symgen
