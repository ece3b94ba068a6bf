#include "symgen/passes/cut_at_functions.h"

#include <algorithm>

#include "symgen/passes/cost.h"

namespace elastogen::symgen {
namespace {

/// Whether others wait long for a node's value: a function, or a power that is no whole positive
/// one. Of parameters alone it is one number for all elements.
bool is_waited_for(const Dag& dag, NodeId id) {
  const Node& node = dag[id];
  if (node.stage <= Stage::material) return false;
  if (node.kind == Kind::function) return node.function != Function::negative_part;
  if (node.kind != Kind::product) return false;
  return std::any_of(node.operands.begin(), node.operands.end(), [&](const Operand& operand) {
    const Exponent exponent = exponent_of(dag.numbers(), operand.factor);
    return exponent.numerator < 0 || exponent.denominator != 1;
  });
}

class Cutter {
 public:
  Cutter(const Dag& dag, std::span<const NodeId> roots, const std::vector<bool>& inputs)
      : dag_(dag), roots_(roots), inputs_(inputs), step_(dag.size(), not_computed) {}

  std::optional<FunctionCut> run() {
    if (!assign_steps()) return std::nullopt;
    FunctionCut cut;
    std::vector<bool> stored(dag_.size(), false);
    const auto read = [&](NodeId id, int reader) {
      if (step_[id] == not_computed || step_[id] >= reader || is_cheap(id)) return;
      stored[id] = true;
    };
    for (std::size_t i = 0; i < dag_.size(); ++i) {
      if (step_[i] == not_computed) continue;
      for (const Operand& operand : dag_[static_cast<NodeId>(i)].operands) {
        read(operand.node, step_[i]);
      }
    }
    for (const NodeId root : roots_) {
      read(root, rest);
      cut.step_of_root.push_back(step_[root] == not_computed ? rest : step_[root]);
    }
    for (std::size_t i = 0; i < dag_.size(); ++i) {
      if (!stored[i]) continue;
      (step_[i] == arguments ? cut.arguments : cut.functions).push_back(static_cast<NodeId>(i));
    }
    return cut;
  }

 private:
  static constexpr int not_computed = -1, arguments = 0, functions = 1, rest = 2;

  bool is_given(NodeId id) const {
    return inputs_[id] || dag_[id].stage <= Stage::material;  // numbers among these
  }

  /// One operation on what is given.
  bool is_cheap(NodeId id) const {
    const Node& node = dag_[id];
    return cost_of(dag_, id).time() <= 1 &&
           std::all_of(node.operands.begin(), node.operands.end(),
                       [this](const Operand& operand) { return is_given(operand.node); });
  }

  /// Returns whether there is a function. Operands have smaller ids than what reads them.
  bool assign_steps() {
    std::vector<bool> needed(dag_.size(), false), feeds(dag_.size(), false),
        waits(dag_.size(), false);
    bool any = false;
    for (const NodeId root : roots_) needed[root] = true;
    for (std::size_t i = dag_.size(); i-- > 0;) {
      const NodeId id = static_cast<NodeId>(i);
      if (is_given(id)) needed[i] = false;
      if (!needed[i]) continue;
      const bool is_function = is_waited_for(dag_, id);
      any = any || is_function;
      waits[i] = is_function;
      for (const Operand& operand : dag_[id].operands) {
        needed[operand.node] = true;
        if (is_function || feeds[i]) feeds[operand.node] = true;
      }
    }
    for (std::size_t i = 0; i < dag_.size(); ++i) {
      if (!needed[i]) continue;
      const bool is_function = waits[i];
      for (const Operand& operand : dag_[static_cast<NodeId>(i)].operands) {
        if (needed[operand.node] && waits[operand.node]) waits[i] = true;
      }
      const bool is_between = waits[i] && feeds[i];
      step_[i] = is_function || is_between ? functions : feeds[i] ? arguments : rest;
    }
    return any;
  }

  const Dag& dag_;
  std::span<const NodeId> roots_;
  const std::vector<bool>& inputs_;
  std::vector<int> step_;
};

}  // namespace

std::optional<FunctionCut> cut_at_functions(const Dag& dag, std::span<const NodeId> roots,
                                            const std::vector<bool>& inputs) {
  return Cutter(dag, roots, inputs).run();
}

}  // namespace elastogen::symgen
