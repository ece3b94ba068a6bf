#include "symgen/dag/lower.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

std::string printed(const GiNaC::ex& expression) {
  std::ostringstream out;
  out << expression;
  return out.str();
}

cln::cl_RA rational_of(const GiNaC::ex& number) {
  const GiNaC::numeric value = GiNaC::ex_to<GiNaC::numeric>(number);
  if (!value.is_rational()) {
    throw InternalError("number " + printed(number) + " is not an exact rational");
  }
  return cln::the<cln::cl_RA>(value.to_cl_N());
}

bool is_commutative(const GiNaC::ex& expression) {
  return GiNaC::is_a<GiNaC::add>(expression) || GiNaC::is_a<GiNaC::mul>(expression);
}

/// A text that does not depend on GiNaC's order: operands of sums and products sorted. Numbers in
/// them are left out, since GiNaC moves signs and contents of inner sums by its own order: -(a - b)
/// c in one run is (b - a) c in the next. With numbers it tells (1 + x) from (2 + x).
std::string canonical_text(const GiNaC::ex& expression, bool with_numbers) {
  if (expression.nops() == 0) return printed(expression);
  std::vector<std::string> operands;
  for (std::size_t i = 0; i < expression.nops(); ++i) {
    const bool is_number =
        is_commutative(expression) && GiNaC::is_a<GiNaC::numeric>(expression.op(i));
    if (is_number && !with_numbers) continue;
    operands.push_back(canonical_text(expression.op(i), with_numbers));
  }
  if (is_commutative(expression) && operands.size() == 1) return operands[0];
  if (is_commutative(expression)) std::sort(operands.begin(), operands.end());
  std::string text = GiNaC::is_a<GiNaC::add>(expression)     ? "+("
                     : GiNaC::is_a<GiNaC::mul>(expression)   ? "*("
                     : GiNaC::is_a<GiNaC::power>(expression) ? "^("
                                                             : "f(";
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    text = GiNaC::ex_to<GiNaC::function>(expression).get_name() + "(";
  }
  for (const std::string& operand : operands) text += operand + ",";
  return text + ")";
}

std::vector<GiNaC::ex> canonical_operands(const GiNaC::ex& expression) {
  std::vector<std::pair<std::string, GiNaC::ex>> keyed;
  for (std::size_t i = 0; i < expression.nops(); ++i) {
    const std::string key =
        canonical_text(expression.op(i), false) + " " + canonical_text(expression.op(i), true);
    keyed.emplace_back(key, expression.op(i));
  }
  if (is_commutative(expression)) {
    std::stable_sort(keyed.begin(), keyed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  std::vector<GiNaC::ex> operands;
  for (const auto& [text, operand] : keyed) operands.push_back(operand);
  return operands;
}

Function function_named(const std::string& name) {
  if (name == "log") return Function::log;
  if (name == "log1p") return Function::log1p;
  if (name == "log1p_remainder") return Function::log1p_remainder;
  if (name == "exp") return Function::exp;
  throw InternalError("function '" + name + "' has no counterpart in the expression graph");
}

}  // namespace

NodeId lower(Dag& dag, const GiNaC::ex& expression, const SymbolNodes& symbols) {
  if (GiNaC::is_a<GiNaC::numeric>(expression)) {
    return dag.number(ExactNumber(rational_of(expression)));
  }
  if (GiNaC::is_a<GiNaC::symbol>(expression)) {
    const auto found = symbols.find(expression);
    if (found == symbols.end()) {
      throw InternalError("symbol " + printed(expression) + " has no node");
    }
    return found->second;
  }
  const std::vector<GiNaC::ex> operands = canonical_operands(expression);
  if (GiNaC::is_a<GiNaC::add>(expression) || GiNaC::is_a<GiNaC::mul>(expression)) {
    std::vector<Operand> lowered;
    for (const GiNaC::ex& operand : operands) {
      lowered.push_back({lower(dag, operand, symbols), NumberPool::one});
    }
    return GiNaC::is_a<GiNaC::add>(expression) ? dag.sum(std::move(lowered))
                                               : dag.product(std::move(lowered));
  }
  if (GiNaC::is_a<GiNaC::power>(expression)) {
    const GiNaC::ex& base = operands[0];
    const cln::cl_RA exponent = rational_of(operands[1]);
    if (GiNaC::is_a<GiNaC::numeric>(base) && cln::denominator(exponent) == 2) {
      const ExactNumber root = ExactNumber::square_root(rational_of(base));
      return dag.number(root.power(cln::cl_I_to_long(cln::numerator(exponent))));
    }
    const NumberId factor = dag.numbers().intern(ExactNumber(exponent));
    return dag.power(lower(dag, base, symbols), factor);
  }
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    const Function function = function_named(GiNaC::ex_to<GiNaC::function>(expression).get_name());
    return dag.function(function, lower(dag, operands[0], symbols));
  }
  throw InternalError("expression " + printed(expression) + " cannot be lowered");
}

ExactNumber exact_value(const GiNaC::ex& expression,
                        const std::map<GiNaC::ex, ExactNumber, GiNaC::ex_is_less>& values) {
  if (GiNaC::is_a<GiNaC::numeric>(expression)) return ExactNumber(rational_of(expression));
  if (GiNaC::is_a<GiNaC::symbol>(expression)) {
    const auto found = values.find(expression);
    if (found == values.end()) {
      throw InternalError("symbol " + printed(expression) + " has no value");
    }
    return found->second;
  }
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    ExactNumber total(0);
    for (const GiNaC::ex& operand : expression) total = total + exact_value(operand, values);
    return total;
  }
  if (GiNaC::is_a<GiNaC::mul>(expression)) {
    ExactNumber total(1);
    for (const GiNaC::ex& operand : expression) total = total * exact_value(operand, values);
    return total;
  }
  if (GiNaC::is_a<GiNaC::power>(expression)) {
    const ExactNumber base = exact_value(expression.op(0), values);
    const cln::cl_RA exponent = rational_of(expression.op(1));
    const long numerator = cln::cl_I_to_long(cln::numerator(exponent));
    if (cln::denominator(exponent) == 1) return base.power(numerator);
    if (cln::denominator(exponent) == 2) {
      return ExactNumber::square_root(base.rational()).power(numerator);
    }
  }
  throw InternalError("expression " + printed(expression) + " has no exact value");
}

}  // namespace elastogen::symgen
