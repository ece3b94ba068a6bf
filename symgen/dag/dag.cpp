#include "symgen/dag/dag.h"

#include <algorithm>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ULL + (hash << 6) + (hash >> 2);
  return hash * 0xff51afd7ed558ccdULL;
}

std::uint64_t hash_of(const Node& node) {
  std::uint64_t hash =
      mix(static_cast<std::uint64_t>(node.kind) * 16 + static_cast<std::uint64_t>(node.function),
          (static_cast<std::uint64_t>(node.value) << 32) | node.symbol);
  for (const Operand& operand : node.operands) {
    hash = mix(hash, (static_cast<std::uint64_t>(operand.node) << 32) | operand.factor);
  }
  return hash;
}

bool same(const Node& a, const Node& b) {
  return a.kind == b.kind && a.function == b.function && a.value == b.value &&
         a.symbol == b.symbol && a.operands == b.operands;
}

}  // namespace

bool is_multiple(const Dag& dag, const Node& node) {
  return node.kind == Kind::product &&
         std::any_of(node.operands.begin(), node.operands.end(), [&](const Operand& operand) {
           return dag[operand.node].kind == Kind::number;
         });
}

bool is_scaled(const Node& node) {
  return node.kind == Kind::sum && node.operands.size() == 1 && node.value == NumberPool::zero;
}

NodeId Dag::intern(Node node) {
  std::sort(node.operands.begin(), node.operands.end());
  if (node.kind != Kind::symbol) {
    node.stage = Stage::literal;
    for (const Operand& operand : node.operands) {
      node.stage = std::max(node.stage, nodes_[operand.node].stage);
    }
  }
  const std::uint64_t hash = hash_of(node);
  const auto [first, last] = by_hash_.equal_range(hash);
  for (auto it = first; it != last; ++it) {
    if (same(nodes_[it->second], node)) return it->second;
  }
  const NodeId id = static_cast<NodeId>(nodes_.size());
  nodes_.push_back(std::move(node));
  by_hash_.emplace(hash, id);
  return id;
}

NodeId Dag::number(NumberId value) {
  Node node;
  node.kind = Kind::number;
  node.value = value;
  return intern(std::move(node));
}

NodeId Dag::symbol(const std::string& name, Stage stage) {
  Node node;
  node.kind = Kind::symbol;
  node.stage = stage;
  const auto known = std::find(symbol_names_.begin(), symbol_names_.end(), name);
  node.symbol = static_cast<std::uint32_t>(known - symbol_names_.begin());
  if (known == symbol_names_.end()) symbol_names_.push_back(name);
  const NodeId id = intern(std::move(node));
  if (nodes_[id].stage != stage) {
    throw InternalError("symbol " + name + " stands for values of two stages");
  }
  return id;
}

void Dag::sort_and_merge(std::vector<Operand>& operands) const {
  std::sort(operands.begin(), operands.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < operands.size();) {
    Operand merged = operands[i++];
    while (i < operands.size() && operands[i].node == merged.node) {
      merged.factor = numbers_->add(merged.factor, operands[i++].factor);
    }
    if (merged.factor != NumberPool::zero) operands[kept++] = merged;
  }
  operands.resize(kept);
}

NodeId Dag::sum(std::vector<Operand> operands, NumberId constant) {
  // Numbers join the constant term; scaled nodes join as their operand.
  for (Operand& operand : operands) {
    const Node& node = nodes_[operand.node];
    if (node.kind == Kind::number) {
      constant = numbers_->add(constant, numbers_->multiply(operand.factor, node.value));
      operand.factor = NumberPool::zero;
    } else if (is_scaled(node)) {
      operand.factor = numbers_->multiply(operand.factor, node.operands[0].factor);
      operand.node = node.operands[0].node;
    }
  }
  sort_and_merge(operands);
  if (operands.empty()) return number(constant);

  // Normalise: the first factor becomes 1.
  const NumberId content = operands[0].factor;
  if (operands.size() == 1 && constant == NumberPool::zero) {
    if (content == NumberPool::one) return operands[0].node;
    Node node;
    node.kind = Kind::sum;
    node.operands = std::move(operands);
    return intern(std::move(node));
  }
  if (content != NumberPool::one) {
    const NumberId inverse = numbers_->inverse(content);
    for (Operand& operand : operands) operand.factor = numbers_->multiply(operand.factor, inverse);
    constant = numbers_->multiply(constant, inverse);
  }
  Node node;
  node.kind = Kind::sum;
  node.value = constant;
  node.operands = std::move(operands);
  const NodeId normalised = intern(std::move(node));
  return content == NumberPool::one ? normalised : sum({{normalised, content}});
}

bool Dag::holds_constant_of_rest(NodeId id) const {
  const Node& node = nodes_[id];
  return node.kind == Kind::product && node.stage > Stage::rest &&
         std::any_of(node.operands.begin(), node.operands.end(), [this](const Operand& operand) {
           return nodes_[operand.node].stage <= Stage::rest;
         });
}

NumberId Dag::take_numbers_out(std::vector<Operand>& operands) const {
  NumberId coefficient = NumberPool::one;
  for (Operand& operand : operands) {
    const Node& node = nodes_[operand.node];
    const auto [n, denominator] = exponent_of(*numbers_, operand.factor);
    if (denominator != 1) continue;
    if (node.kind == Kind::number) {
      coefficient = numbers_->multiply(coefficient, numbers_->power(node.value, n));
      operand.factor = NumberPool::zero;
    } else if (is_scaled(node)) {
      coefficient = numbers_->multiply(coefficient, numbers_->power(node.operands[0].factor, n));
      operand.node = node.operands[0].node;
    }
  }
  std::erase_if(operands, [](const Operand& each) { return each.factor == NumberPool::zero; });
  return coefficient;
}

NodeId Dag::scaled_product(NumberId coefficient, std::vector<Operand> operands) {
  if (operands.empty() || coefficient == NumberPool::zero) return number(coefficient);
  NodeId result = operands[0].node;
  if (operands.size() > 1 || operands[0].factor != NumberPool::one) {
    Node node;
    node.kind = Kind::product;
    node.operands = std::move(operands);
    result = intern(std::move(node));
  }
  return coefficient == NumberPool::one ? result : scale(coefficient, result);
}

NodeId Dag::product(std::vector<Operand> operands) {
  const NumberId coefficient = take_numbers_out(operands);
  if (coefficient == NumberPool::zero) return number(NumberPool::zero);

  // Open nested products. Constants of two of them must not meet: c1 (c2 s) with c2 s computed
  // anyway costs less than another constant c1 c2, and needs no storage.
  const auto num_sources =
      std::count_if(operands.begin(), operands.end(), [this](const Operand& operand) {
        return nodes_[operand.node].stage <= Stage::rest || holds_constant_of_rest(operand.node);
      });
  std::vector<Operand> flat;
  for (const Operand& operand : operands) {
    const bool is_integer = exponent_of(*numbers_, operand.factor).denominator == 1;
    const bool stays_whole = num_sources > 1 && holds_constant_of_rest(operand.node);
    if (nodes_[operand.node].kind != Kind::product || !is_integer || stays_whole) {
      flat.push_back(operand);
      continue;
    }
    for (const Operand& inner : nodes_[operand.node].operands) {
      flat.push_back({inner.node, numbers_->multiply(inner.factor, operand.factor)});
    }
  }
  sort_and_merge(flat);

  // What is known at rest is one factor of what is not: a grouped constant that no later pass
  // takes apart.
  std::vector<Operand> rest, rest_of_all;
  for (const Operand& operand : flat) {
    (nodes_[operand.node].stage <= Stage::rest ? rest : rest_of_all).push_back(operand);
  }
  if (!rest_of_all.empty() &&
      (rest.size() > 1 || (rest.size() == 1 && rest[0].factor != NumberPool::one))) {
    Node constant;
    constant.kind = Kind::product;
    constant.operands = std::move(rest);
    rest_of_all.push_back({intern(std::move(constant)), NumberPool::one});
    flat = std::move(rest_of_all);
  }
  return scaled_product(coefficient, std::move(flat));
}

NodeId Dag::product_of_groups(std::vector<Operand> operands) {
  const NumberId coefficient = take_numbers_out(operands);
  sort_and_merge(operands);
  return scaled_product(coefficient, std::move(operands));
}

NodeId Dag::multiple(NumberId factor, NodeId a) {
  Node node;
  node.kind = Kind::product;
  node.operands = {{number(factor), NumberPool::one}, {a, NumberPool::one}};
  sort_and_merge(node.operands);
  return intern(std::move(node));
}

NodeId Dag::function(Function function, NodeId argument) {
  const Node& inner = nodes_[argument];
  if (inner.kind == Kind::number) {
    const bool zero = inner.value == NumberPool::zero;
    const bool vanishes_at_zero =
        function == Function::log1p || function == Function::log1p_remainder ||
        function == Function::expm1_remainder || function == Function::negative_part;
    if (zero && vanishes_at_zero) return number(NumberPool::zero);
    if (zero && function == Function::exp) return number(NumberPool::one);
    if (inner.value == NumberPool::one && function == Function::log) {
      return number(NumberPool::zero);
    }
  }
  Node node;
  node.kind = Kind::function;
  node.function = function;
  node.operands = {{argument, NumberPool::one}};
  return intern(std::move(node));
}

NodeId Dag::add(NodeId a, NodeId b) { return sum({{a, NumberPool::one}, {b, NumberPool::one}}); }
NodeId Dag::subtract(NodeId a, NodeId b) {
  return sum({{a, NumberPool::one}, {b, NumberPool::minus_one}});
}
NodeId Dag::multiply(NodeId a, NodeId b) {
  return product({{a, NumberPool::one}, {b, NumberPool::one}});
}
NodeId Dag::inverse(NodeId a) { return product({{a, NumberPool::minus_one}}); }

std::vector<bool> Dag::reachable(std::span<const NodeId> roots) const {
  std::vector<bool> needed(nodes_.size(), false);
  for (const NodeId root : roots) needed[root] = true;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    if (!needed[i]) continue;
    for (const Operand& operand : nodes_[i].operands) needed[operand.node] = true;
  }
  return needed;
}

std::vector<NodeId> copy_into(Dag& target, const Dag& source, std::span<const NodeId> roots) {
  return rebuild(source, roots, [&](NodeId id, Node node) {
    return node.kind == Kind::symbol ? target.symbol(source.symbol_name(id), node.stage)
                                     : target.intern(std::move(node));
  });
}

std::vector<NodeId> substitute_into(Dag& target, const Dag& source, std::span<const NodeId> roots,
                                    const std::unordered_map<NodeId, NodeId>& images) {
  return rebuild(source, roots, [&](NodeId id, Node node) {
    switch (node.kind) {
      case Kind::symbol:
        return images.at(id);
      case Kind::sum:
        return target.sum(std::move(node.operands), node.value);
      case Kind::product:
        return target.product(std::move(node.operands));
      case Kind::function:
        return target.function(node.function, node.operands[0].node);
      case Kind::number:
        break;
    }
    return target.number(node.value);
  });
}

Exponent exponent_of(const NumberPool& numbers, NumberId factor) {
  if (factor == NumberPool::one) return {1, 1};
  if (factor == NumberPool::minus_one) return {-1, 1};
  const cln::cl_RA value = numbers.exact(factor).rational();
  return {cln::cl_I_to_long(cln::numerator(value)), cln::cl_I_to_long(cln::denominator(value))};
}

}  // namespace elastogen::symgen
