// Expressions as users write them: checked, made exact, parsed by GiNaC.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <utility>
#include <vector>

namespace elastogen::symgen {

/// Names that may stand in an expression, under the heading that messages list them by.
struct SymbolGroup {
  std::string heading;  ///< "parameters"
  std::vector<std::pair<std::string, GiNaC::symbol>> symbols;
};

/// Parses + - * / ^ ( ), numbers, the groups' symbols, and the functions log, sqrt, exp. Decimals
/// are exact: 0.1 is 1/10, 2.5e-3 is 1/400. A sign stands at the start or after '(' only, and
/// a^b^c needs parentheses, so that nothing hangs on rules of precedence that differ between
/// languages.
/// @throws InputError  for an unknown symbol (with the nearest known one and all that is allowed),
///                     bad syntax (with the column), a division by zero, a result that is not
///                     real; the message names the expression, the caller adds file and line
[[nodiscard]] GiNaC::ex parse_expression(const std::string& text,
                                         const std::vector<SymbolGroup>& groups);

/// The text without spaces: equal for expressions that differ only in how they are set.
/// @throws InputError  for a character that cannot stand in an expression
[[nodiscard]] std::string without_spaces(const std::string& text);

/// The exact value of a decimal number, "-2.5e-3".
/// @throws InputError  if it is none, or its exponent is not within -400 ... 400
[[nodiscard]] GiNaC::numeric exact_decimal(const std::string& text);

/// Names that cannot be given to parameters because they mean something in expressions.
[[nodiscard]] const std::vector<std::string>& reserved_names();

}  // namespace elastogen::symgen
