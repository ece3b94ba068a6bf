// Walking the graph with any number type: the slow, obvious reference for every fast path.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "runtime/error.h"
#include "symgen/dag/dag.h"

namespace elastogen::symgen {

/// The law's domain was left: a logarithm or root of a number that is not positive, or a division
/// by zero. Exact arithmetic has no NaN to carry it.
class OutsideDomain : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// A finite double, exactly; CLN's own conversion refuses denormal numbers.
/// @throws InputError  for one that is not finite
[[nodiscard]] cln::cl_RA exact_value(double value);

/// Arithmetic of the walk for double; the pattern for other number types.
struct DoubleArithmetic {
  using Number = double;
  [[nodiscard]] Number from_exact(const ExactNumber& value) const { return value.to_double(); }
  [[nodiscard]] Number add(Number a, Number b) const { return a + b; }
  [[nodiscard]] Number multiply(Number a, Number b) const { return a * b; }
  [[nodiscard]] Number power(Number base, const cln::cl_RA& exponent) const;
  [[nodiscard]] Number apply(Function function, Number x) const;
};

/// CLN floating-point numbers of a given number of decimal digits. Functions carry extra digits
/// where their definition cancels.
class ClnArithmetic {
 public:
  using Number = cln::cl_R;
  explicit ClnArithmetic(unsigned digits = 60)
      : digits_(digits), format_(cln::float_format(digits)) {}
  [[nodiscard]] Number from_exact(const ExactNumber& value) const;
  [[nodiscard]] Number from_double(double value) const;
  [[nodiscard]] Number add(const Number& a, const Number& b) const { return a + b; }
  [[nodiscard]] Number multiply(const Number& a, const Number& b) const { return a * b; }
  /// @throws OutsideDomain  when the result is not a finite real number; so does apply
  [[nodiscard]] Number power(const Number& base, const cln::cl_RA& exponent) const;
  [[nodiscard]] Number apply(Function function, const Number& x) const;

 private:
  unsigned digits_;
  cln::float_format_t format_;
};

/// Values of `roots`; `input` gives the value of a symbol node. Sums and products are taken in
/// the order of their operands.
template <class Arithmetic>
[[nodiscard]] std::vector<typename Arithmetic::Number> evaluate(
    const Dag& dag, std::span<const NodeId> roots, const Arithmetic& arithmetic,
    const std::function<typename Arithmetic::Number(NodeId)>& input) {
  using Number = typename Arithmetic::Number;
  const std::vector<bool> needed = dag.reachable(roots);
  const NumberPool& numbers = dag.numbers();
  std::vector<Number> value(needed.size());
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    const Node& node = dag[static_cast<NodeId>(i)];
    switch (node.kind) {
      case Kind::number:
        value[i] = arithmetic.from_exact(numbers.exact(node.value));
        break;
      case Kind::symbol:
        value[i] = input(static_cast<NodeId>(i));
        break;
      case Kind::sum: {
        Number total = arithmetic.from_exact(numbers.exact(node.value));
        for (const Operand& operand : node.operands) {
          Number term = value[operand.node];
          if (operand.factor != NumberPool::one) {
            term = arithmetic.multiply(arithmetic.from_exact(numbers.exact(operand.factor)), term);
          }
          total = arithmetic.add(total, term);
        }
        value[i] = total;
        break;
      }
      case Kind::product: {
        Number total = arithmetic.from_exact(ExactNumber(1));
        for (const Operand& operand : node.operands) {
          total = arithmetic.multiply(
              total, operand.factor == NumberPool::one
                         ? value[operand.node]
                         : arithmetic.power(value[operand.node],
                                            numbers.exact(operand.factor).rational()));
        }
        value[i] = total;
        break;
      }
      case Kind::function:
        value[i] = arithmetic.apply(node.function, value[node.operands[0].node]);
        break;
    }
  }
  std::vector<Number> result;
  for (const NodeId root : roots) result.push_back(value[root]);
  return result;
}

}  // namespace elastogen::symgen
