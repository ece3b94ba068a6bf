// Units of parameters and energies: as text, as powers of the base units, and of expressions.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

namespace elastogen::symgen {

/// Base units of the SI, as far as laws meet them.
enum BaseUnit : std::size_t { kilogram, metre, second, ampere, kelvin, mole, num_base_units };

/// A unit as rational powers of the base units; of a plain number all are 0.
struct Unit {
  std::array<GiNaC::numeric, num_base_units> powers;

  [[nodiscard]] bool is_plain_number() const;
  [[nodiscard]] bool operator==(const Unit& other) const;
  [[nodiscard]] Unit operator*(const Unit& other) const;
  [[nodiscard]] Unit operator/(const Unit& other) const;
  [[nodiscard]] Unit to_power(const GiNaC::numeric& exponent) const;
};

/// Reads products of powers of kg, m, s, A, K, mol, N, Pa, J, W, Hz: "Pa", "1/Pa", "N/m^2", "Pa*s",
/// "Pa*sqrt(m)", and "1" for a plain number.
/// @throws InputError  for another name (with the nearest), a prefix (with what to write), a
/// factor,
///                     a sum
[[nodiscard]] Unit parse_unit(const std::string& text);

/// The shortest text for a unit: "Pa", "Pa^2", "1/Pa", "Pa*s", "kg/m^3", "1".
[[nodiscard]] std::string unit_text(const Unit& unit);

/// What a symbol stands for.
struct Quantity {
  GiNaC::symbol symbol;
  Unit unit;
};

/// The unit that an expression comes out in. Symbols that are not among the quantities are plain
/// numbers, as numbers are.
/// @throws InputError  with the subexpression: summands of different units, the logarithm or the
///                     exponential of what has a unit, exponents that have one or give one
[[nodiscard]] Unit unit_of(const GiNaC::ex& expression, const std::vector<Quantity>& quantities);

/// Checks that an expression comes out in a unit, each of its summands by itself; 0 fits any.
/// @param required  as `parse_unit` reads it
/// @throws InputError  as `unit_of`, or with the summand, its unit and the required one
void check_unit(const GiNaC::ex& expression, const std::vector<Quantity>& quantities,
                const std::string& required);

}  // namespace elastogen::symgen
