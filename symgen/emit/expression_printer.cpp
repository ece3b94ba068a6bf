#include "symgen/emit/expression_printer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

std::string temporary_name(int index) { return fmt::format("t{}", index); }

/// Products of whole powers that a single sum uses are written inside it.
bool is_written_inside_sum(const Statement& statement) {
  if (statement.kind != Kind::product || statement.uses != 1 || !statement.used_by_sum) {
    return false;
  }
  return std::all_of(statement.factors.begin(), statement.factors.end(), [](const Factor& factor) {
    return factor.exponent.denominator == 1 && factor.exponent.numerator >= 1;
  });
}

}  // namespace

void ExpressionPrinter::print(const Fragment& fragment, bool accumulate, SourceWriter& out) const {
  for (std::size_t i = 0; i < fragment.statements.size(); ++i) {
    const Statement& statement = fragment.statements[i];
    if (is_written_inside_sum(statement)) continue;
    out.line(declaration(temporary_name(static_cast<int>(i)), statement.uniform) + " = " +
             right_side(fragment, statement) + ";");
  }
  for (const Output& each : fragment.outputs) {
    std::string text = output_value(fragment, each.value);
    bool negative = each.negative;
    if (each.size.entry >= 0) {
      text = tabulated_number(each.size.entry) + " * " + text;
    } else if (each.size.value != NumberPool::one) {
      const double size = numbers_.value(each.size.value);
      negative = negative != (size < 0);
      if (std::abs(size) != 1) text = number(std::abs(size)) + " * " + text;
    }
    if (each.index == Output::margin) {
      out.line(margin_update(negative ? "-" + text : text));
      continue;
    }
    const std::string target = output(each.index, each.entry);
    if (accumulate) {
      out.line(target + (negative ? " -= " : " += ") + text + ";");
    } else {
      out.line(target + " = " + (negative ? "-" : "") + text + ";");
    }
  }
}

std::string ExpressionPrinter::array_name(Slot slot) {
  switch (slot) {
    case Slot::position:
      return "x";
    case Slot::parameter:
      return "p";
    case Slot::constant:
      return "c";
    case Slot::displacement:
      return "u";
    case Slot::direction:
      return "v";
    case Slot::state:
      return "s";
    case Slot::carried:
      return "w";
    case Slot::number:
    case Slot::temporary:
      break;
  }
  throw InternalError("not an input array");
}

std::string ExpressionPrinter::name_of(Function function) {
  switch (function) {
    case Function::log:
      return "log";
    case Function::log1p:
      return "log1p";
    case Function::log1p_remainder:
      return "log1p_remainder";
    case Function::exp:
      return "exp";
    case Function::expm1_remainder:
      return "expm1_remainder";
    case Function::negative_part:
      return "negative_part";
    case Function::none:
      break;
  }
  throw InternalError("unknown function");
}

std::string ExpressionPrinter::output_value(const Fragment& fragment,
                                            const Reference& reference) const {
  const std::string text = value(reference);
  const bool is_uniform =
      reference.slot == Slot::number || reference.slot == Slot::parameter ||
      (reference.slot == Slot::temporary && fragment.statements[reference.index].uniform);
  return is_uniform ? spread(text) : text;
}

std::string ExpressionPrinter::right_side(const Fragment& fragment,
                                          const Statement& statement) const {
  switch (statement.kind) {
    case Kind::sum:
      return sum(fragment, statement);
    case Kind::product:
      return product(statement);
    case Kind::function:
      return function_call(statement.function, value(statement.factors[0].value));
    case Kind::number:
    case Kind::symbol:
      break;
  }
  throw InternalError("a number or symbol is no statement");
}

std::string ExpressionPrinter::literal(const Literal& value) const {
  return value.entry >= 0 ? tabulated_number(value.entry) : number(numbers_.value(value.value));
}

std::string ExpressionPrinter::value(const Reference& reference) const {
  if (reference.slot == Slot::number) {
    return number(numbers_.value(static_cast<NumberId>(reference.index)));
  }
  if (reference.slot == Slot::temporary) return temporary_name(reference.index);
  return input(reference.slot, reference.index, reference.entry);
}

std::string ExpressionPrinter::term(const Fragment& fragment, const Reference& reference) const {
  if (reference.slot == Slot::temporary) {
    const Statement& statement = fragment.statements[reference.index];
    if (is_written_inside_sum(statement)) return product(statement);
  }
  return value(reference);
}

std::string ExpressionPrinter::sum(const Fragment& fragment, const Statement& statement) const {
  std::string text;
  const auto append = [&text](bool negative, const std::string& part) {
    if (text.empty()) {
      text = negative ? fmt::format("-{}", part) : part;
    } else {
      text += fmt::format(" {} {}", negative ? '-' : '+', part);
    }
  };
  for (const TermGroup& group : statement.groups) {
    if (group.size.value == NumberPool::one && group.size.entry < 0) {
      for (const TermGroup::Term& each : group.terms) {
        append(each.negative, term(fragment, each.value));
      }
      continue;
    }
    const double size = numbers_.value(group.size.value);
    if (group.size.entry < 0 && size < 0) {  // plain style: the sign is in the number
      const std::string inner = term(fragment, group.terms[0].value);
      append(true, size == -1 ? inner : number(-size) + " * " + inner);
      continue;
    }
    const bool flipped = group.terms[0].negative;
    std::string inner;
    for (const TermGroup::Term& each : group.terms) {
      if (!inner.empty()) inner += each.negative != flipped ? " - " : " + ";
      inner += term(fragment, each.value);
    }
    if (group.terms.size() > 1) inner = fmt::format("({})", inner);
    append(flipped, literal(group.size) + " * " + inner);
  }
  if (statement.constant.entry >= 0) {
    append(false, tabulated_number(statement.constant.entry));
  } else if (statement.constant.value != NumberPool::zero) {
    const double constant = numbers_.value(statement.constant.value);
    append(constant < 0, number(constant < 0 ? -constant : constant));
  }
  return text;
}

std::string ExpressionPrinter::product(const Statement& statement) const {
  std::string text;
  for (const Factor& factor : statement.factors) {
    const std::string base = value(factor.value);
    const auto [numerator, denominator] = factor.exponent;
    if (denominator != 1 || numerator < 0) {
      // group_stages leaves only whole powers of reciprocals and roots, each a statement alone
      std::string power = denominator == 1 ? base : root(base, denominator);
      return numerator < 0 ? fmt::format("{} / {}", number(1), power) : power;
    }
    for (long k = 0; k < numerator; ++k) {
      if (!text.empty()) text += " * ";
      text += base;
    }
  }
  return text;
}

}  // namespace elastogen::symgen
