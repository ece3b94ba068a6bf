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

/// Operands in an order that does not depend on GiNaC's: by a text in which the operands of sums
/// and products are sorted. Numbers in them are left out at first, since GiNaC moves signs and
/// contents of inner sums by its own order: -(a - b) c in one run is (b - a) c in the next. With
/// numbers it tells (1 + x) from (2 + x). Texts are kept: derivatives repeat their subexpressions.
class CanonicalOrder {
 public:
  std::vector<GiNaC::ex> operands(const GiNaC::ex& expression) {
    std::vector<std::pair<std::string, GiNaC::ex>> keyed;
    for (std::size_t i = 0; i < expression.nops(); ++i) {
      const GiNaC::ex operand = expression.op(i);
      keyed.emplace_back(text(operand, false) + " " + text(operand, true), operand);
    }
    if (is_commutative(expression)) {
      std::stable_sort(keyed.begin(), keyed.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
    }
    std::vector<GiNaC::ex> operands;
    for (const auto& [key, operand] : keyed) operands.push_back(operand);
    return operands;
  }

 private:
  using Texts = std::map<GiNaC::ex, std::string, GiNaC::ex_is_less>;

  const std::string& text(const GiNaC::ex& expression, bool with_numbers) {
    Texts& texts = with_numbers ? with_numbers_ : without_numbers_;
    if (const auto known = texts.find(expression); known != texts.end()) return known->second;
    return texts.emplace(expression, compose(expression, with_numbers)).first->second;
  }

  std::string compose(const GiNaC::ex& expression, bool with_numbers) {
    if (expression.nops() == 0) return printed(expression);
    std::vector<std::string> operands;
    for (std::size_t i = 0; i < expression.nops(); ++i) {
      const bool is_number =
          is_commutative(expression) && GiNaC::is_a<GiNaC::numeric>(expression.op(i));
      if (is_number && !with_numbers) continue;
      operands.push_back(text(expression.op(i), with_numbers));
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

  Texts with_numbers_, without_numbers_;
};

Function function_named(const std::string& name) {
  if (name == "log") return Function::log;
  if (name == "log1p") return Function::log1p;
  if (name == "log1p_remainder") return Function::log1p_remainder;
  if (name == "exp") return Function::exp;
  if (name == "expm1_remainder") return Function::expm1_remainder;
  if (name == "negative_part") return Function::negative_part;
  throw InternalError("function '" + name + "' has no counterpart in the expression graph");
}

/// Lowers expressions that share subexpressions, each of them once.
class Lowering {
 public:
  Lowering(Dag& dag, const SymbolNodes& symbols) : dag_(dag), symbols_(symbols) {}

  NodeId lowered(const GiNaC::ex& expression) {
    if (GiNaC::is_a<GiNaC::numeric>(expression)) {
      return dag_.number(ExactNumber(rational_of(expression)));
    }
    if (GiNaC::is_a<GiNaC::symbol>(expression)) {
      const auto found = symbols_.find(expression);
      if (found == symbols_.end()) {
        throw InternalError("symbol " + printed(expression) + " has no node");
      }
      return found->second;
    }
    if (const auto known = nodes_.find(expression); known != nodes_.end()) return known->second;
    return nodes_.emplace(expression, composed(expression)).first->second;
  }

 private:
  NodeId composed(const GiNaC::ex& expression) {
    const std::vector<GiNaC::ex> operands = order_.operands(expression);
    if (is_commutative(expression)) {
      std::vector<Operand> lowered_operands;
      for (const GiNaC::ex& operand : operands) {
        lowered_operands.push_back({lowered(operand), NumberPool::one});
      }
      return GiNaC::is_a<GiNaC::add>(expression) ? dag_.sum(std::move(lowered_operands))
                                                 : dag_.product(std::move(lowered_operands));
    }
    if (GiNaC::is_a<GiNaC::power>(expression)) {
      const GiNaC::ex& base = operands[0];
      const cln::cl_RA exponent = rational_of(operands[1]);
      if (GiNaC::is_a<GiNaC::numeric>(base) && cln::denominator(exponent) == 2) {
        const ExactNumber root = ExactNumber::square_root(rational_of(base));
        return dag_.number(root.power(cln::cl_I_to_long(cln::numerator(exponent))));
      }
      return dag_.power(lowered(base), dag_.numbers().intern(ExactNumber(exponent)));
    }
    if (GiNaC::is_a<GiNaC::function>(expression)) {
      const std::string name = GiNaC::ex_to<GiNaC::function>(expression).get_name();
      return dag_.function(function_named(name), lowered(operands[0]));
    }
    throw InternalError("expression " + printed(expression) + " cannot be lowered");
  }

  Dag& dag_;
  const SymbolNodes& symbols_;
  CanonicalOrder order_;
  std::map<GiNaC::ex, NodeId, GiNaC::ex_is_less> nodes_;
};

}  // namespace

std::vector<NodeId> lower(Dag& dag, const std::vector<GiNaC::ex>& expressions,
                          const SymbolNodes& symbols) {
  Lowering lowering(dag, symbols);
  std::vector<NodeId> nodes;
  for (const GiNaC::ex& expression : expressions) nodes.push_back(lowering.lowered(expression));
  return nodes;
}

NodeId lower(Dag& dag, const GiNaC::ex& expression, const SymbolNodes& symbols) {
  return lower(dag, std::vector<GiNaC::ex>{expression}, symbols)[0];
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
