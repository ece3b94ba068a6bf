#include "symgen/passes/absorb_factor.h"

#include <algorithm>

namespace elastogen::symgen {
namespace {

/// Degree in which values are homogeneous in one constant, by node; none if they are not.
class Degrees {
 public:
  Degrees(const Dag& dag, const std::vector<bool>& is_constant, NodeId chosen)
      : dag_(dag), degree_(dag.size()) {
    for (std::size_t i = 0; i < dag.size(); ++i) {
      const NodeId id = static_cast<NodeId>(i);
      degree_[i] = is_constant[i] ? (id == chosen ? 1 : 0) : degree_of(dag[id]);
    }
  }
  [[nodiscard]] bool all_are(std::span<const NodeId> nodes, long degree) const {
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](NodeId id) { return dag_.is_zero(id) || degree_[id] == degree; });
  }

 private:
  [[nodiscard]] std::optional<long> degree_of(const Node& node) const {
    if (node.kind == Kind::number || node.kind == Kind::symbol) return 0;
    std::optional<long> result;
    if (node.kind != Kind::sum || node.value != NumberPool::zero) result = 0;
    for (const Operand& operand : node.operands) {
      std::optional<long> part = degree_[operand.node];
      if (!part) return std::nullopt;
      if (node.kind == Kind::sum) {
        if (result && *result != *part) return std::nullopt;
        result = part;
      } else if (*part != 0) {
        const Exponent exponent = exponent_of(dag_.numbers(), operand.factor);
        if (node.kind == Kind::function || exponent.denominator != 1) return std::nullopt;
        *result += *part * exponent.numerator;
      }
    }
    return result;
  }

  const Dag& dag_;
  std::vector<std::optional<long>> degree_;
};

/// The factor, without its sign, that all have in common; none if it is 1 or differs.
std::optional<NumberId> common_factor(const Dag& dag, std::span<const NodeId> nodes) {
  std::optional<NumberId> common;
  for (const NodeId id : nodes) {
    if (dag.is_zero(id)) continue;
    if (!is_scaled(dag[id])) return std::nullopt;
    const NumberId factor = dag.numbers().size(dag[id].operands[0].factor);
    if (common && *common != factor) return std::nullopt;
    common = factor;
  }
  return common == NumberPool::one ? std::nullopt : common;
}

}  // namespace

std::optional<AbsorbedFactor> absorb_factor(const Dag& dag, std::span<const NodeId> nodal,
                                            std::span<const NodeId> energies,
                                            std::span<const NodeId> margins,
                                            const std::vector<NodeId>& constants) {
  const std::optional<NumberId> factor = common_factor(dag, nodal);
  if (!factor) return std::nullopt;
  std::vector<bool> is_constant(dag.size(), false);
  for (const NodeId id : constants) is_constant[id] = true;
  for (std::size_t k = 0; k < constants.size(); ++k) {
    const Degrees degrees(dag, is_constant, constants[k]);
    if (degrees.all_are(nodal, 1) && degrees.all_are(energies, 1) && degrees.all_are(margins, 0)) {
      return AbsorbedFactor{k, *factor};
    }
  }
  return std::nullopt;
}

}  // namespace elastogen::symgen
