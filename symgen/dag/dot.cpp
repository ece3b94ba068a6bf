#include "symgen/dag/dot.h"

#include <fmt/format.h>

#include <algorithm>

namespace elastogen::symgen {
namespace {

const char* colour_of(Stage stage) {
  switch (stage) {
    case Stage::literal:
      return "white";
    case Stage::material:
      return "khaki";
    case Stage::rest:
      return "lightblue";
    case Stage::state:
      return "palegreen";
    case Stage::direction:
      return "lightsalmon";
  }
  return "white";
}

std::string label_of(const Dag& dag, NodeId id) {
  const Node& node = dag[id];
  switch (node.kind) {
    case Kind::number:
      return dag.numbers().exact(node.value).text();
    case Kind::symbol:
      return dag.symbol_name(id);
    case Kind::sum:
      return node.value == NumberPool::zero ? "+" : "+ " + dag.numbers().exact(node.value).text();
    case Kind::product:
      return "*";
    case Kind::function:
      break;
  }
  switch (node.function) {
    case Function::log:
      return "log";
    case Function::log1p:
      return "log1p";
    case Function::expm1_remainder:
      return "exp(y) - 1 - y";
    case Function::negative_part:
      return "max(0, -x)";
    case Function::log1p_remainder:
      return "x - log1p";
    case Function::exp:
      return "exp";
    case Function::none:
      break;
  }
  return "?";
}

}  // namespace

std::string print_dot(const Dag& dag, std::span<const LabelledRoot> roots,
                      std::span<const NodeId> stored, const std::string& title) {
  std::vector<NodeId> ids;
  for (const LabelledRoot& root : roots) ids.push_back(root.node);
  const std::vector<bool> needed = dag.reachable(ids);
  std::string text = fmt::format(
      "digraph \"{0}\" {{\n  label=\"{0}: parameters khaki, rest blue, state green, direction "
      "salmon; doubly framed: stored\";\n  rankdir=BT;\n  node [style=filled];\n",
      title);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    const NodeId id = static_cast<NodeId>(i);
    const bool is_stored = std::find(stored.begin(), stored.end(), id) != stored.end();
    text += fmt::format("  n{} [label=\"{}\", fillcolor={}, shape={}, peripheries={}];\n", i,
                        label_of(dag, id), colour_of(dag[id].stage),
                        dag[id].kind == Kind::symbol ? "box" : "ellipse", is_stored ? 2 : 1);
    for (const Operand& operand : dag[id].operands) {
      const std::string factor = dag.numbers().exact(operand.factor).text();
      const bool plain = operand.factor == NumberPool::one;
      text += fmt::format("  n{} -> n{}{};\n", operand.node, i,
                          plain ? ""
                                : fmt::format(" [label=\"{}{}\"]",
                                              dag[id].kind == Kind::product ? "^" : "", factor));
    }
  }
  for (std::size_t k = 0; k < roots.size(); ++k) {
    text += fmt::format("  r{0} [label=\"{1}\", shape=box, fillcolor=white];\n  n{2} -> r{0};\n", k,
                        roots[k].label, roots[k].node);
  }
  return text + "}\n";
}

}  // namespace elastogen::symgen
