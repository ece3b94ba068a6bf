#include "symgen/law/expression_text.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

/// How tightly a text binds, so that parentheses stand where they must and nowhere else.
enum class Binding { sum, product, power };

struct Text {
  std::string text;
  Binding binding = Binding::power;
};

std::string parenthesised(const Text& text, Binding needed) {
  return text.binding < needed ? "(" + text.text + ")" : text.text;
}

Text render(const GiNaC::ex& expression);

Text render_number(const GiNaC::ex& number) {
  std::ostringstream stream;
  stream << number;
  const bool composed = stream.str().find_first_of("-/") != std::string::npos;
  return {stream.str(), composed ? Binding::product : Binding::power};
}

Text render_sum(const GiNaC::ex& sum) {
  std::vector<std::string> operands;
  for (const GiNaC::ex& operand : sum) {
    operands.push_back(parenthesised(render(operand), Binding::product));
  }
  const auto sign_less = [](const std::string& s) { return s.substr(s.starts_with('-') ? 1 : 0); };
  std::sort(operands.begin(), operands.end(), [&](const std::string& a, const std::string& b) {
    return sign_less(a) < sign_less(b);
  });
  std::string text = operands.front();
  for (std::size_t i = 1; i < operands.size(); ++i) {
    text += (operands[i].starts_with('-') ? " - " : " + ") + sign_less(operands[i]);
  }
  return {text, Binding::sum};
}

Text render_power(const GiNaC::ex& base, const GiNaC::ex& exponent) {
  if (exponent.is_equal(GiNaC::numeric(1, 2))) return {"sqrt(" + render(base).text + ")"};
  // The base binds tighter than a power itself: (a^b)^c.
  Text inner = render(base);
  if (GiNaC::is_a<GiNaC::power>(base)) inner.binding = Binding::sum;
  Text outer = render(exponent);
  if (!GiNaC::is_a<GiNaC::symbol>(exponent) && !exponent.info(GiNaC::info_flags::posint)) {
    outer.binding = Binding::sum;
  }
  return {parenthesised(inner, Binding::power) + "^" + parenthesised(outer, Binding::power)};
}

/// Whether the text of a sum starts with a minus.
bool leads_with_minus(const GiNaC::ex& expression) {
  return GiNaC::is_a<GiNaC::add>(expression) && render(expression).text.starts_with('-');
}

/// A factor of a product, base^exponent.
struct Factor {
  GiNaC::ex base;
  GiNaC::ex exponent;
};

/// Splits a factor so that a sum as its base starts with a plus: GiNaC writes 1 - x as -(-1 + x) or
/// not, depending on an order that may change from run to run. The sign goes to the coefficient.
Factor split_factor(const GiNaC::ex& operand, GiNaC::numeric& coefficient) {
  Factor factor{operand, 1};
  if (GiNaC::is_a<GiNaC::power>(operand)) factor = {operand.op(0), operand.op(1)};
  if (factor.exponent.info(GiNaC::info_flags::integer) && leads_with_minus(factor.base)) {
    if (factor.exponent.info(GiNaC::info_flags::odd)) coefficient = -coefficient;
    factor.base = -factor.base;
  }
  return factor;
}

/// Factors with negative exponents stand behind '/'.
Text render_product(const GiNaC::ex& product) {
  GiNaC::numeric coefficient = 1;
  std::vector<std::string> factors;
  std::vector<std::string> divisors;
  for (const GiNaC::ex& operand : product) {
    if (GiNaC::is_a<GiNaC::numeric>(operand)) {
      coefficient *= GiNaC::ex_to<GiNaC::numeric>(operand);
      continue;
    }
    const Factor factor = split_factor(operand, coefficient);
    const bool divides = factor.exponent.info(GiNaC::info_flags::negative);
    const GiNaC::ex exponent = divides ? -factor.exponent : factor.exponent;
    const Text text =
        exponent.is_equal(1) ? render(factor.base) : render_power(factor.base, exponent);
    (divides ? divisors : factors).push_back(parenthesised(text, Binding::power));
  }
  std::sort(factors.begin(), factors.end());
  std::sort(divisors.begin(), divisors.end());
  const bool is_unit = GiNaC::abs(coefficient) == 1;
  if (!is_unit || factors.empty()) {
    factors.insert(factors.begin(), render_number(GiNaC::abs(coefficient)).text);
  }
  std::string text = coefficient < 0 ? "-" : "";
  for (std::size_t i = 0; i < factors.size(); ++i) text += (i > 0 ? "*" : "") + factors[i];
  for (const std::string& divisor : divisors) text += "/" + divisor;
  return {text, Binding::product};
}

Text render_function(const GiNaC::ex& call) {
  std::string text = GiNaC::ex_to<GiNaC::function>(call).get_name() + "(";
  for (std::size_t i = 0; i < call.nops(); ++i) {
    text += (i > 0 ? ", " : "") + render(call.op(i)).text;
  }
  return {text + ")"};
}

Text render(const GiNaC::ex& expression) {
  if (GiNaC::is_a<GiNaC::symbol>(expression)) {
    return {GiNaC::ex_to<GiNaC::symbol>(expression).get_name()};
  }
  if (GiNaC::is_a<GiNaC::numeric>(expression)) return render_number(expression);
  if (GiNaC::is_a<GiNaC::add>(expression)) return render_sum(expression);
  if (GiNaC::is_a<GiNaC::mul>(expression)) return render_product(expression);
  if (GiNaC::is_a<GiNaC::power>(expression)) {
    return expression.op(1).info(GiNaC::info_flags::negative)
               ? render_product(GiNaC::lst{expression})
               : render_power(expression.op(0), expression.op(1));
  }
  if (GiNaC::is_a<GiNaC::function>(expression)) return render_function(expression);
  throw InternalError("an expression holds something that is no sum, product, power or function");
}

}  // namespace

std::string expression_text(const GiNaC::ex& expression) { return render(expression).text; }

}  // namespace elastogen::symgen
