// The expression graph: commutative, hash-consed, exact.
//
// Semantics, once for everybody:
//   number    an exact number
//   symbol    an input (a parameter, a rest position, a displacement, a direction ...)
//   sum       value + sum of factor_k * operand_k, in any order; no operand twice, no zero factor
//   product   product of operand_k ^ factor_k, in any order; factors are rational exponents
//   function  function(operand_0)
// Subtraction, negation, division and roots are factors, so nothing is ordered. Sums are
// normalised: the first operand's factor is 1 and what was taken out stands in the operand that
// refers to the sum, so expressions that differ by a number share one node. Regrouping and
// reordering are exact here because numbers are; only evaluation rounds.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "symgen/dag/number.h"

namespace elastogen::symgen {

/// When an expression's inputs are known; a node's stage is the largest of its operands'.
enum class Stage : std::uint8_t { literal, material, rest, state, direction };

enum class Kind : std::uint8_t { number, symbol, sum, product, function };

enum class Function : std::uint8_t {
  none,
  log,
  log1p,
  log1p_remainder,
  exp,
  expm1_remainder,
  negative_part
};

using NodeId = std::uint32_t;

/// An operand of a sum (factor: coefficient) or product (factor: exponent, rational).
struct Operand {
  NodeId node;
  NumberId factor;
  auto operator<=>(const Operand&) const = default;
};

struct Node {
  Kind kind = Kind::number;
  Function function = Function::none;
  Stage stage = Stage::literal;
  NumberId value = NumberPool::zero;  ///< number: the number; sum: its constant term
  std::uint32_t symbol = 0;           ///< index into Dag::symbol_names
  std::vector<Operand> operands;      ///< ascending by node; one with factor 1 for functions
};

/// A multiple of another node: a sum of one operand without constant term.
[[nodiscard]] bool is_scaled(const Node& node);

class Dag;
/// A multiple that stays one operand of products, from Dag::multiple.
[[nodiscard]] bool is_multiple(const Dag& dag, const Node& node);

/// A growing graph. Operands always precede the nodes that use them, so ascending ids are a
/// topological order. Ids depend only on the order of construction: the same calls give the same
/// graph.
class Dag {
 public:
  Dag() : numbers_(std::make_shared<NumberPool>()) {}
  /// An empty graph that shares the numbers of another.
  explicit Dag(std::shared_ptr<NumberPool> numbers) : numbers_(std::move(numbers)) {}

  // Construction with simplification.
  [[nodiscard]] NodeId number(NumberId value);
  [[nodiscard]] NodeId number(const ExactNumber& value) { return number(numbers_->intern(value)); }
  [[nodiscard]] NodeId symbol(const std::string& name, Stage stage);
  [[nodiscard]] NodeId sum(std::vector<Operand> operands, NumberId constant = NumberPool::zero);
  [[nodiscard]] NodeId product(std::vector<Operand> operands);
  /// As `product`, but operands that are products stay whole: for passes that have grouped them.
  [[nodiscard]] NodeId product_of_groups(std::vector<Operand> operands);
  [[nodiscard]] NodeId function(Function function, NodeId argument);
  [[nodiscard]] NodeId scale(NumberId factor, NodeId a) { return sum({{a, factor}}); }
  /// factor * a as a product with a number, which passes that keep products whole leave whole:
  /// what is multiplied by it does not become a multiple. `product` takes it apart.
  [[nodiscard]] NodeId multiple(NumberId factor, NodeId a);
  [[nodiscard]] NodeId add(NodeId a, NodeId b);
  [[nodiscard]] NodeId subtract(NodeId a, NodeId b);
  [[nodiscard]] NodeId multiply(NodeId a, NodeId b);
  [[nodiscard]] NodeId inverse(NodeId a);
  [[nodiscard]] NodeId power(NodeId a, NumberId exponent) { return product({{a, exponent}}); }

  /// The node with exactly these fields (operands sorted, none merged or flattened): for passes
  /// that have decided the structure. Sets the stage.
  [[nodiscard]] NodeId intern(Node node);

  [[nodiscard]] const Node& operator[](NodeId id) const { return nodes_[id]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const std::string& symbol_name(NodeId id) const {
    return symbol_names_[nodes_[id].symbol];
  }
  [[nodiscard]] bool is_zero(NodeId id) const {
    return nodes_[id].kind == Kind::number && nodes_[id].value == NumberPool::zero;
  }
  [[nodiscard]] NumberPool& numbers() const { return *numbers_; }
  [[nodiscard]] const std::shared_ptr<NumberPool>& number_pool() const { return numbers_; }

  /// Marks every node that some root needs (indexed by node id).
  [[nodiscard]] std::vector<bool> reachable(std::span<const NodeId> roots) const;

 private:
  /// A product of later stage with a factor that is known at rest.
  [[nodiscard]] bool holds_constant_of_rest(NodeId id) const;
  /// Removes numbers and the factors of scaled nodes from a product's operands; their product.
  [[nodiscard]] NumberId take_numbers_out(std::vector<Operand>& operands) const;
  /// coefficient * product of operands, which are sorted and merged.
  [[nodiscard]] NodeId scaled_product(NumberId coefficient, std::vector<Operand> operands);
  void sort_and_merge(std::vector<Operand>& operands) const;

  std::shared_ptr<NumberPool> numbers_;
  std::vector<Node> nodes_;
  std::unordered_multimap<std::uint64_t, NodeId> by_hash_;
  std::vector<std::string> symbol_names_;
};

/// A graph together with the values that are wanted of it, in order.
struct Graph {
  Dag dag;
  std::vector<NodeId> roots;
};

/// Rebuilds what `roots` need, operands first: `make(id, node)` returns the image of source[id],
/// whose operands `node` refers to by their images. Returns the roots' images.
template <class Make>
std::vector<NodeId> rebuild(const Dag& source, std::span<const NodeId> roots, const Make& make) {
  const std::vector<bool> needed = source.reachable(roots);
  std::vector<NodeId> image(needed.size());
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    const NodeId id = static_cast<NodeId>(i);
    Node node = source[id];
    for (Operand& operand : node.operands) operand.node = image[operand.node];
    image[i] = make(id, std::move(node));
  }
  std::vector<NodeId> result;
  for (const NodeId root : roots) result.push_back(image[root]);
  return result;
}

/// Copies what `roots` need from `source` into `target`, structure unchanged; returns the roots'
/// ids there. Both graphs must share one number pool.
std::vector<NodeId> copy_into(Dag& target, const Dag& source, std::span<const NodeId> roots);

/// As copy_into, but each symbol becomes the node that `images` has for it, and sums and products
/// are simplified anew: what becomes a number or zero goes.
std::vector<NodeId> substitute_into(Dag& target, const Dag& source, std::span<const NodeId> roots,
                                    const std::unordered_map<NodeId, NodeId>& images);

/// An exponent as numerator and denominator.
/// @throws InternalError  if it is irrational or huge
struct Exponent {
  long numerator, denominator;
};
[[nodiscard]] Exponent exponent_of(const NumberPool& numbers, NumberId factor);

}  // namespace elastogen::symgen
