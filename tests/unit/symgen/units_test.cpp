#include "symgen/law/units.h"

#include <gtest/gtest.h>

#include "runtime/error.h"
#include "symgen/law/expression.h"
#include "tests/unit/message_of.h"

namespace elastogen::symgen {
namespace {

using test::message_of;

struct Spelling {
  const char *written, *usual;
};

class UnitText : public testing::TestWithParam<Spelling> {};

TEST_P(UnitText, IsTheShortest) {
  EXPECT_EQ(unit_text(parse_unit(GetParam().written)), GetParam().usual);
}

INSTANTIATE_TEST_SUITE_P(
    All, UnitText,
    testing::Values(Spelling{"1", "1"}, Spelling{"Pa", "Pa"}, Spelling{"N/m^2", "Pa"},
                    Spelling{"J/m^3", "Pa"}, Spelling{"kg/(m*s^2)", "Pa"}, Spelling{"1/Pa", "1/Pa"},
                    Spelling{"m^2/N", "1/Pa"}, Spelling{"Pa^2", "Pa^2"}, Spelling{"Pa*Pa", "Pa^2"},
                    Spelling{"Pa*s", "Pa*s"}, Spelling{"kg/m/s", "Pa*s"},
                    Spelling{"1/(Pa*s)", "1/(Pa*s)"}, Spelling{"1/Pa*s", "s/Pa"},
                    Spelling{"Pa*sqrt(m)", "Pa*m^(1/2)"}, Spelling{"Pa^(-1/2)", "1/Pa^(1/2)"},
                    Spelling{"Pa/Pa", "1"}, Spelling{"J/m^2", "N/m"}, Spelling{"kg/s^2", "N/m"},
                    Spelling{"N/m^3", "Pa/m"}, Spelling{"N*m", "J"}, Spelling{"J/s", "W"},
                    Spelling{"N*s", "N*s"}, Spelling{"J/kg", "m^2/s^2"},
                    Spelling{"kg/m^3", "kg/m^3"}, Spelling{"1/K", "1/K"}, Spelling{"Hz", "1/s"},
                    Spelling{"Pa/K", "Pa/K"}, Spelling{"W/(m*K)", "W/(m*K)"},
                    Spelling{"mol/m^3", "mol/m^3"}, Spelling{"N/A^2", "N/A^2"}));

struct NoUnit {
  const char *name, *text, *message;
};

class ParseUnitError : public testing::TestWithParam<NoUnit> {};

TEST_P(ParseUnitError, IsExplained) {
  const std::string message = message_of<InputError>([] { (void)parse_unit(GetParam().text); });
  EXPECT_EQ(message.find(GetParam().message), 0U) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Texts, ParseUnitError,
    testing::Values(
        NoUnit{
            "Prefix", "MPa",
            "\"MPa\": 'MPa' has a prefix, and values are taken in SI units without one: write Pa "
            "and give values in it (1 MPa = 1e6 Pa)"},
        NoUnit{"PrefixInProduct", "N/mm^2", "\"N/mm^2\": 'mm' has a prefix"},
        NoUnit{"Gram", "g/m^3",
               "\"g/m^3\": 'g' has a prefix, and values are taken in SI units "
               "without one: write kg and give values in it (1 g = 1e-3 kg)"},
        NoUnit{"Unknown", "Pas",
               "\"Pas\": unknown symbol 'Pas' at column 1; did you mean 'Pa'?; "
               "allowed are units kg, m, s, A, K, mol, N, Pa, J, W, Hz"},
        NoUnit{"Bar", "bar", "\"bar\": unknown symbol 'bar' at column 1"},
        NoUnit{"Factor", "1000*Pa", "\"1000*Pa\" is no unit: must be a product of powers"},
        NoUnit{"Sum", "Pa + N", "\"Pa + N\" is no unit"},
        NoUnit{"Logarithm", "log(Pa)", "\"log(Pa)\" is no unit"},
        NoUnit{"SymbolicPower", "Pa^m", "\"Pa^m\" is no unit"},
        NoUnit{"Zero", "0", "\"0\" is no unit"},
        NoUnit{"RaisedDigit", "N/m²",
               "\"N/m²\": column 4: '²' cannot stand here; allowed are numbers, names (ASCII "
               "letters, digits and '_') and + - * / ^ ( ); write ^2 for it"}),
    [](const auto& text) { return text.param.name; });

/// Expressions in k and m [Pa], c [1/Pa], e [Pa*s] and x, a plain number.
class UnitOf : public testing::Test {
 protected:
  std::string unit(const std::string& text) const {
    return unit_text(unit_of(parse(text), quantities_));
  }
  std::string error(const std::string& text) const {
    return message_of<InputError>([&] { check_unit(parse(text), quantities_, "J/m^3"); });
  }
  void accept(const std::string& text) const {
    EXPECT_NO_THROW(check_unit(parse(text), quantities_, "J/m^3")) << text;
  }

 private:
  GiNaC::ex parse(const std::string& text) const {
    return parse_expression(text,
                            {{"symbols", {{"k", k}, {"m", m}, {"c", c}, {"e", e}, {"x", x}}}});
  }
  GiNaC::symbol k = GiNaC::symbol("k"), m = GiNaC::symbol("m"), c = GiNaC::symbol("c"),
                e = GiNaC::symbol("e"), x = GiNaC::symbol("x");
  std::vector<Quantity> quantities_ = {{k, parse_unit("Pa")},
                                       {m, parse_unit("N/m^2")},
                                       {c, parse_unit("1/Pa")},
                                       {e, parse_unit("Pa*s")}};
};

TEST_F(UnitOf, FollowsTheExpression) {
  EXPECT_EQ(unit("k*m"), "Pa^2");
  EXPECT_EQ(unit("sqrt(k*m)*x"), "Pa");
  EXPECT_EQ(unit("k^(-1/2)"), "1/Pa^(1/2)");
  EXPECT_EQ(unit("(3*k + m/2)*c"), "1");
  EXPECT_EQ(unit("e/k"), "s");
  EXPECT_EQ(unit("log(k/m)*exp(c*k) + x"), "1");
  EXPECT_EQ(unit("k*(k*c)^x"), "Pa");
}

TEST_F(UnitOf, EnergiesOfManyForms) {
  for (const char* energy : {"k/2*x^2", "x^2/c", "sqrt(k*m)*(exp(x*c*k) - 1)", "k*x + m*(x - 1)^2",
                             "k*log(k/m)*x - k*x", "0", "k*m*c*x", "k^2/(k + m)*x"}) {
    accept(energy);
  }
}

TEST_F(UnitOf, NamesTheSummandAndBothUnits) {
  EXPECT_EQ(error("m*x + k*m*x^2"),
            "'k*m*x^2' is in Pa^2 (k is in Pa, m is in Pa), must be in J/m^3 (Pa): multiply it by "
            "something in 1/Pa, or mend a parameter's unit");
  EXPECT_EQ(error("e*x"),
            "'e*x' is in Pa*s (e is in Pa*s), must be in J/m^3 (Pa): multiply it by something in "
            "1/s, or mend a parameter's unit");
  EXPECT_EQ(error("k*x + x^2/2"),
            "'1/2*x^2' is a plain number, must be in J/m^3 (Pa): multiply it by a parameter in Pa");
}

TEST_F(UnitOf, NamesWhatCannotBeAdded) {
  EXPECT_EQ(error("x*(k + 1)"),
            "in '1 + k', '1' is a plain number and 'k' is in Pa: what is added must have the same "
            "unit");
  EXPECT_EQ(error("k*x*sqrt(c*e + x)"),
            "in 'c*e + x', 'c*e' is in s and 'x' is a plain number: what is added must have the "
            "same unit");
}

TEST_F(UnitOf, NamesWhatMustBeAPlainNumber) {
  EXPECT_EQ(error("m*(exp(k*x) - 1)"),
            "in 'exp(k*x)', the argument 'k*x' is in Pa, must be a plain number: divide it by "
            "something in Pa");
  EXPECT_EQ(error("m*log(e)"),
            "in 'log(e)', the argument 'e' is in Pa*s, must be a plain number: divide it by "
            "something in Pa*s");
  EXPECT_EQ(
      error("m*x^k"),
      "in 'x^k', the exponent 'k' is in Pa, must be a plain number: divide it by something in "
      "Pa");
  EXPECT_EQ(error("m^x"),
            "in 'm^x', the base of an exponent that is no number, 'm' is in Pa, must be a plain "
            "number: divide it by something in Pa");
}

}  // namespace
}  // namespace elastogen::symgen
