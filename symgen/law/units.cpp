#include "symgen/law/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/error.h"
#include "symgen/law/expression.h"
#include "symgen/law/expression_text.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

struct NamedUnit {
  std::string name;
  Unit unit;
  GiNaC::symbol symbol;
};

const std::vector<NamedUnit>& named_units() {
  static const std::vector<NamedUnit> all = [] {
    std::vector<NamedUnit> units;
    const auto add = [&](const char* name, int kg, int m, int s, int a = 0, int k = 0,
                         int mol = 0) {
      units.push_back({name, {{kg, m, s, a, k, mol}}, GiNaC::symbol(name)});
    };
    add("kg", 1, 0, 0);
    add("m", 0, 1, 0);
    add("s", 0, 0, 1);
    add("A", 0, 0, 0, 1);
    add("K", 0, 0, 0, 0, 1);
    add("mol", 0, 0, 0, 0, 0, 1);
    add("N", 1, 1, -2);
    add("Pa", 1, -1, -2);
    add("J", 1, 2, -2);
    add("W", 1, 2, -3);
    add("Hz", 0, 0, -1);
    return units;
  }();
  return all;
}

const NamedUnit* find_unit(const std::string& name) {
  const auto found = std::find_if(named_units().begin(), named_units().end(),
                                  [&](const NamedUnit& unit) { return unit.name == name; });
  return found == named_units().end() ? nullptr : &*found;
}

/// What to write for a name that is a known one with a prefix, and how large it is.
struct Prefixed {
  std::string name, power;
};

std::optional<Prefixed> find_prefixed(const std::string& name) {
  if (name == "g") return Prefixed{"kg", "1e-3"};
  static const std::vector<std::pair<std::string, std::string>> prefixes = {
      {"da", "10"},  {"h", "100"},  {"k", "1e3"},  {"M", "1e6"},  {"G", "1e9"},  {"T", "1e12"},
      {"d", "1e-1"}, {"c", "1e-2"}, {"m", "1e-3"}, {"u", "1e-6"}, {"n", "1e-9"}, {"p", "1e-12"}};
  for (const auto& [prefix, power] : prefixes) {
    if (!name.starts_with(prefix)) continue;
    const NamedUnit* unit = find_unit(name.substr(prefix.size()));
    if (unit != nullptr && unit->name != "kg") return Prefixed{unit->name, power};
  }
  return std::nullopt;
}

void refuse_prefixes(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  for (auto begin = text.begin(); begin != text.end();) {
    begin = std::find_if(begin, text.end(), is_letter);
    const auto end = std::find_if_not(begin, text.end(), is_letter);
    const std::string name(begin, end);
    begin = end;
    if (find_unit(name) != nullptr) continue;
    if (const std::optional<Prefixed> prefixed = find_prefixed(name)) {
      throw InputError(
          fmt::format("\"{}\": '{}' has a prefix, and values are taken in SI units without one: "
                      "write {} and give values in it (1 {} = {} {})",
                      text, name, prefixed->name, name, prefixed->power, prefixed->name));
    }
  }
}

/// A product of powers of symbols, without a factor.
bool is_product_of_powers(const ex& expression) {
  if (GiNaC::is_a<GiNaC::symbol>(expression) || expression.is_equal(1)) return true;
  if (GiNaC::is_a<GiNaC::power>(expression)) {
    return is_product_of_powers(expression.op(0)) &&
           expression.op(1).info(GiNaC::info_flags::rational);
  }
  return GiNaC::is_a<GiNaC::mul>(expression) &&
         std::all_of(expression.begin(), expression.end(), is_product_of_powers);
}

std::string power_text(const std::string& name, const numeric& exponent) {
  if (exponent == 1) return name;
  const std::string text = expression_text(exponent);
  return name + "^" + (exponent.is_integer() ? text : "(" + text + ")");
}

struct Factor {
  std::string name;
  numeric exponent;
};

std::string product_text(const std::vector<Factor>& factors) {
  std::string above, below;
  int num_below = 0;
  for (const Factor& factor : factors) {
    const bool divides = factor.exponent.is_negative();
    std::string& side = divides ? below : above;
    num_below += divides ? 1 : 0;
    side += (side.empty() ? "" : "*") +
            power_text(factor.name, divides ? -factor.exponent : factor.exponent);
  }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + "/" + (num_below > 1 ? "(" + below + ")" : below);
}

/// The unit with as much of a derived one as it has kilograms, and base units for the rest.
std::vector<Factor> factors_with(const NamedUnit* derived, const Unit& unit) {
  std::vector<Factor> factors;
  Unit rest = unit;
  if (derived != nullptr) {
    factors.push_back({derived->name, unit.powers[kilogram]});
    rest = unit / derived->unit.to_power(unit.powers[kilogram]);
  }
  for (std::size_t base = 0; base < num_base_units; ++base) {
    if (!rest.powers[base].is_zero()) {
      factors.push_back({named_units()[base].name, rest.powers[base]});
    }
  }
  return factors;
}

/// Fewer factors first, then smaller exponents.
std::pair<std::size_t, numeric> length_of(const std::vector<Factor>& factors) {
  numeric sum = 0;
  for (const Factor& factor : factors) sum += GiNaC::abs(factor.exponent);
  return {factors.size(), sum};
}

/// "is a plain number", "is in Pa".
std::string is_in(const Unit& unit) {
  return unit.is_plain_number() ? "is a plain number" : "is in " + unit_text(unit);
}

/// Operands by their text: GiNaC's own order may change from run to run.
std::vector<std::pair<std::string, ex>> sorted_operands(const ex& sum) {
  std::vector<std::pair<std::string, ex>> operands;
  for (const ex& operand : sum) operands.emplace_back(expression_text(operand), operand);
  std::sort(operands.begin(), operands.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return operands;
}

Unit unit_of_sum(const ex& sum, const std::vector<Quantity>& quantities) {
  const std::vector<std::pair<std::string, ex>> operands = sorted_operands(sum);
  const Unit first = unit_of(operands.front().second, quantities);
  for (const auto& [text, operand] : operands) {
    const Unit unit = unit_of(operand, quantities);
    if (unit == first) continue;
    throw InputError(
        fmt::format("in '{}', '{}' {} and '{}' {}: what is added must have the same unit",
                    expression_text(sum), operands.front().first, is_in(first), text, is_in(unit)));
  }
  return first;
}

void require_plain_number(const ex& part, const ex& whole, const char* what,
                          const std::vector<Quantity>& quantities) {
  const Unit unit = unit_of(part, quantities);
  if (unit.is_plain_number()) return;
  throw InputError(fmt::format(
      "in '{}', {} '{}' is in {}, must be a plain number: divide it by something in {}",
      expression_text(whole), what, expression_text(part), unit_text(unit), unit_text(unit)));
}

/// The units of the quantities in an expression, for those that have one: " (c1 is in Pa)".
std::string quantities_text(const ex& expression, const std::vector<Quantity>& quantities) {
  std::string text;
  for (const Quantity& quantity : quantities) {
    if (quantity.unit.is_plain_number() || !expression.has(quantity.symbol)) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", quantity.symbol.get_name(),
                        is_in(quantity.unit));
  }
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace

bool Unit::is_plain_number() const { return *this == Unit(); }

bool Unit::operator==(const Unit& other) const { return powers == other.powers; }

Unit Unit::operator*(const Unit& other) const {
  Unit product;
  for (std::size_t b = 0; b < num_base_units; ++b) product.powers[b] = powers[b] + other.powers[b];
  return product;
}

Unit Unit::operator/(const Unit& other) const { return *this * other.to_power(-1); }

Unit Unit::to_power(const numeric& exponent) const {
  Unit power;
  for (std::size_t b = 0; b < num_base_units; ++b) power.powers[b] = powers[b] * exponent;
  return power;
}

Unit parse_unit(const std::string& text) {
  refuse_prefixes(text);
  SymbolGroup group{"units", {}};
  std::vector<Quantity> quantities;
  for (const NamedUnit& unit : named_units()) {
    group.symbols.emplace_back(unit.name, unit.symbol);
    quantities.push_back({unit.symbol, unit.unit});
  }
  const ex product = parse_expression(text, {group});
  if (!is_product_of_powers(product)) {
    throw InputError(fmt::format(
        "\"{}\" is no unit: must be a product of powers without a factor, as in Pa, 1/Pa, N/m^2 or "
        "Pa*s, or 1 for a plain number; values are taken in SI units",
        text));
  }
  return unit_of(product, quantities);
}

std::string unit_text(const Unit& unit) {
  std::vector<Factor> shortest = factors_with(nullptr, unit);
  if (unit.powers[kilogram].is_zero()) return product_text(shortest);
  for (const char* name : {"W", "N", "Pa", "J"}) {
    const std::vector<Factor> factors = factors_with(find_unit(name), unit);
    if (length_of(factors) < length_of(shortest)) shortest = factors;
  }
  return product_text(shortest);
}

Unit unit_of(const ex& expression, const std::vector<Quantity>& quantities) {
  if (GiNaC::is_a<GiNaC::add>(expression)) return unit_of_sum(expression, quantities);
  if (GiNaC::is_a<GiNaC::mul>(expression)) {
    Unit product;
    for (const ex& factor : expression) product = product * unit_of(factor, quantities);
    return product;
  }
  if (GiNaC::is_a<GiNaC::power>(expression)) {
    const ex &base = expression.op(0), &exponent = expression.op(1);
    if (GiNaC::is_a<numeric>(exponent)) {
      return unit_of(base, quantities).to_power(GiNaC::ex_to<numeric>(exponent));
    }
    require_plain_number(exponent, expression, "the exponent", quantities);
    require_plain_number(base, expression, "the base of an exponent that is no number,",
                         quantities);
    return {};
  }
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    require_plain_number(expression.op(0), expression, "the argument", quantities);
    return {};
  }
  const auto known = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const Quantity& q) { return expression.is_equal(q.symbol); });
  return known == quantities.end() ? Unit() : known->unit;
}

void check_unit(const ex& expression, const std::vector<Quantity>& quantities,
                const std::string& required) {
  if (expression.is_zero()) return;
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    for (const auto& [text, summand] : sorted_operands(expression)) {
      check_unit(summand, quantities, required);
    }
    return;
  }
  const Unit wanted = parse_unit(required), found = unit_of(expression, quantities);
  if (found == wanted) return;
  const std::string known = quantities_text(expression, quantities);
  const std::string wanted_text = unit_text(wanted), missing = unit_text(wanted / found);
  throw InputError(fmt::format(
      "'{}' {}{}, must be in {}{}: {}", expression_text(expression), is_in(found), known, required,
      wanted_text == required ? "" : " (" + wanted_text + ")",
      known.empty()
          ? fmt::format("multiply it by a parameter in {}", missing)
          : fmt::format("multiply it by something in {}, or mend a parameter's unit", missing)));
}

}  // namespace elastogen::symgen
