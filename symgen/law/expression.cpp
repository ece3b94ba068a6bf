#include "symgen/law/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "runtime/error.h"
#include "symgen/law/characters.h"
#include "symgen/law/names.h"

namespace elastogen::symgen {
namespace {

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = {"log", "sqrt", "exp"};
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

enum class TokenKind { number, name, sign };

struct Token {
  TokenKind kind;
  std::string text;
  std::size_t column;  ///< from 1
};

[[noreturn]] void fail(const std::string& text, const std::string& what) {
  throw InputError(fmt::format("\"{}\": {}", text, what));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_character(char c) {
  return is_identifier(std::string(1, c)) || is_digit(c) || c == '_';
}

/// End of the number that starts at `begin`: digits, a point, an exponent if digits follow it.
std::size_t end_of_number(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  const auto skip_digits = [&] {
    while (end < text.size() && is_digit(text[end])) ++end;
  };
  skip_digits();
  if (end < text.size() && text[end] == '.') {
    ++end;
    skip_digits();
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      end = exponent;
      skip_digits();
    }
  }
  return end;
}

std::vector<Token> tokenise(const std::string& text) {
  std::vector<Token> tokens;
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    std::size_t end = i + 1;
    TokenKind kind = TokenKind::sign;
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++i;
      continue;
    }
    if (is_digit(c) || (c == '.' && end < text.size() && is_digit(text[end]))) {
      kind = TokenKind::number;
      end = end_of_number(text, i);
    } else if (is_name_character(c)) {
      kind = TokenKind::name;
      while (end < text.size() && is_name_character(text[end])) ++end;
    } else if (std::string("+-*/^()").find(c) == std::string::npos) {
      const std::string character = character_at(text, i);
      fail(text, fmt::format("column {}: '{}' cannot stand here; allowed are numbers, names (ASCII "
                             "letters, digits and '_') and + - * / ^ ( ){}",
                             i + 1, character, in_ascii(character)));
    }
    tokens.push_back({kind, text.substr(i, end - i), i + 1});
    i = end;
  }
  return tokens;
}

/// Checks the grammar, so that GiNaC's parser sees only what it reads as meant: it reports no
/// positions, takes 2^-x*y for 2^(-x*y), and crashes on log().
class SyntaxCheck {
 public:
  SyntaxCheck(const std::string& text, const std::vector<SymbolGroup>& groups)
      : text_(text), groups_(groups), tokens_(tokenise(text)) {}

  /// The tokens, if they make an expression.
  std::vector<Token> run() {
    if (tokens_.empty()) fail(text_, "the expression is empty");
    for (position_ = 0; position_ < tokens_.size(); ++position_) {
      if (operand_expected_) {
        take_operand(tokens_[position_]);
      } else {
        take_operator(tokens_[position_]);
      }
    }
    if (operand_expected_) fail(text_, "ends where a number or a symbol is missing");
    if (depth_ > 0) fail(text_, fmt::format("{} closing ')' missing", depth_));
    return tokens_;
  }

 private:
  bool next_is(const char* text) const {
    return position_ + 1 < tokens_.size() && tokens_[position_ + 1].text == text;
  }

  [[noreturn]] void fail_at(const Token& token, const std::string& what) const {
    fail(text_, fmt::format("column {}: {}", token.column, what));
  }

  void take_operand(const Token& token) {
    if (token.kind == TokenKind::number) {
      operand_expected_ = false;
    } else if (token.kind == TokenKind::name) {
      take_name(token);
    } else if (token.text == "(") {
      open_parenthesis();
    } else if (token.text == "+" || token.text == "-") {
      if (position_ > 0 && tokens_[position_ - 1].text != "(") {
        fail_at(token, fmt::format("a sign after '{0}': put it in parentheses, as in {0}(-2)",
                                   tokens_[position_ - 1].text));
      }
    } else {
      fail_at(token, fmt::format("a number or a symbol is missing before '{}'", token.text));
    }
  }

  void take_name(const Token& token) {
    const bool is_function = contains(function_names(), token.text);
    if (is_function && next_is("(")) {
      ++position_;
      open_parenthesis();
      return;
    }
    if (is_function) fail_at(token, fmt::format("'{0}' needs an argument, {0}(...)", token.text));
    if (next_is("(")) {
      fail_at(token,
              fmt::format("'{}' is no function{}; functions are {}", token.text,
                          suggestion(token.text, function_names()), join_names(function_names())));
    }
    check_symbol(token);
    operand_expected_ = false;
  }

  void check_symbol(const Token& token) const {
    std::vector<std::string> known;
    std::string allowed;
    for (const SymbolGroup& group : groups_) {
      std::vector<std::string> names;
      for (const auto& [name, symbol] : group.symbols) names.push_back(name);
      known.insert(known.end(), names.begin(), names.end());
      allowed += fmt::format("{} {}; ", group.heading, join_names(names));
    }
    if (contains(known, token.text)) return;
    fail(text_, fmt::format("unknown symbol '{}' at column {}{}; allowed are {}functions {}",
                            token.text, token.column, suggestion(token.text, known), allowed,
                            join_names(function_names())));
  }

  void take_operator(const Token& token) {
    if (token.text == ")") {
      if (depth_ == 0) fail_at(token, "')' without '('");
      --depth_;
      has_power_ = outer_powers_.back();
      outer_powers_.pop_back();
      return;
    }
    if (token.kind != TokenKind::sign || token.text == "(") {
      fail_at(token, fmt::format("an operator is missing before '{}'", token.text));
    }
    if (token.text == "^" && has_power_) {
      fail_at(token, "a^b^c is ambiguous: write (a^b)^c or a^(b^c)");
    }
    has_power_ = token.text == "^";
    operand_expected_ = true;
  }

  void open_parenthesis() {
    ++depth_;
    outer_powers_.push_back(has_power_);
    has_power_ = false;
  }

  const std::string& text_;
  const std::vector<SymbolGroup>& groups_;
  std::vector<Token> tokens_;
  std::size_t position_ = 0;
  bool operand_expected_ = true;
  int depth_ = 0;
  bool has_power_ = false;          ///< the last operator at this depth was '^'
  std::vector<bool> outer_powers_;  ///< the same at the depths around
};

bool has_complex_number(const GiNaC::ex& expression) {
  return std::any_of(
      expression.preorder_begin(), expression.preorder_end(), [](const GiNaC::ex& part) {
        return GiNaC::is_a<GiNaC::numeric>(part) && !GiNaC::ex_to<GiNaC::numeric>(part).is_real();
      });
}

}  // namespace

GiNaC::numeric exact_decimal(const std::string& text) {
  const bool is_negative = !text.empty() && text.front() == '-';
  const std::string digits = is_negative ? text.substr(1) : text;
  if (digits.empty() || !(is_digit(digits[0]) || digits[0] == '.') ||
      end_of_number(digits, 0) != digits.size()) {
    throw InputError(fmt::format("'{}' is no decimal number", text));
  }
  GiNaC::numeric value = 0;
  int exponent = 0;
  bool is_fraction = false;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] == '.') {
      is_fraction = true;
    } else if (is_digit(digits[i])) {
      value = 10 * value + (digits[i] - '0');
      if (is_fraction) --exponent;
    } else {
      int scale = 0;
      const std::size_t begin = i + (digits[i + 1] == '+' ? 2 : 1);
      const auto [end, error] =
          std::from_chars(digits.data() + begin, digits.data() + digits.size(), scale);
      if (error != std::errc() || scale < -400 || scale > 400) {
        throw InputError(fmt::format("'{}': exponents must be within -400 ... 400", text));
      }
      exponent += scale;
      break;
    }
  }
  value *= GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(exponent));
  return is_negative ? -value : value;
}

std::string without_spaces(const std::string& text) {
  std::string result;
  for (const Token& token : tokenise(text)) result += token.text;
  return result;
}

const std::vector<std::string>& reserved_names() {
  // Beside the functions: what GiNaC's parser takes for constants.
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result = function_names();
    result.insert(result.end(), {"I", "Pi", "Euler", "Catalan"});
    return result;
  }();
  return names;
}

GiNaC::ex parse_expression(const std::string& text, const std::vector<SymbolGroup>& groups) {
  std::string exact;
  for (const Token& token : SyntaxCheck(text, groups).run()) {
    if (token.kind == TokenKind::number) {
      std::ostringstream number;
      number << exact_decimal(token.text);
      exact += fmt::format("({})", number.str());
    } else {
      exact += token.text;
    }
  }
  GiNaC::symtab symbols;
  for (const SymbolGroup& group : groups) {
    for (const auto& [name, symbol] : group.symbols) symbols[name] = symbol;
  }
  try {
    GiNaC::parser parser(symbols, true);
    const GiNaC::ex result = parser(exact);
    if (has_complex_number(result)) fail(text, "is not real");
    return result;
  } catch (const GiNaC::pole_error&) {
    fail(text, "divides by zero or takes the logarithm of zero");
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    fail(text, fmt::format("cannot be parsed ({})", error.what()));
  }
}

}  // namespace elastogen::symgen
