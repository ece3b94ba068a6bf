#include "symgen/passes/share_pairs.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace elastogen::symgen {
namespace {

/// Sums longer than this are left alone: the number of pairs grows with the square.
constexpr std::size_t longest_sum = 400;

struct Pair {
  NodeId a, b;     // a < b
  NumberId ratio;  // factor of b / factor of a
  bool operator==(const Pair&) const = default;
};

struct PairHash {
  std::size_t operator()(const Pair& pair) const {
    std::uint64_t hash = (static_cast<std::uint64_t>(pair.a) << 32) | pair.b;
    hash ^= static_cast<std::uint64_t>(pair.ratio) * 0x9e3779b97f4a7c15ULL;
    hash *= 0xff51afd7ed558ccdULL;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

/// The graph while pairs are taken out: nodes may be changed and are not hash-consed.
class Sharing {
 public:
  Sharing(const Graph& graph, Stage from) : numbers_(graph.dag.numbers()), from_(from) {
    nodes_.reserve(graph.dag.size());
    for (std::size_t i = 0; i < graph.dag.size(); ++i) {
      nodes_.push_back(graph.dag[static_cast<NodeId>(i)]);
    }
    needed_ = graph.dag.reachable(graph.roots);
  }

  void share(Kind kind) {
    kind_ = kind;
    counts_.clear();
    holders_.assign(nodes_.size(), {});
    queue_ = {};
    for (NodeId id = 0; id < nodes_.size(); ++id) {
      if (!takes_part(id)) continue;
      for (const Operand& operand : nodes_[id].operands) holders_[operand.node].push_back(id);
      count_pairs(id, +1);
    }
    for (const auto& [pair, count] : counts_) {
      if (count > 1) queue_.emplace(count, pair);
    }
    while (!queue_.empty()) {
      const auto [count, pair] = queue_.top();
      queue_.pop();
      const auto current = counts_.find(pair);
      if (current == counts_.end() || current->second != count || count < 2) continue;
      take_out(pair);
    }
  }

  Graph rebuild(const Graph& original) {
    Graph result{Dag(original.dag.number_pool()), {}};
    std::vector<NodeId> image(nodes_.size());
    std::vector<char> state(nodes_.size(), 0);  // 0 new, 1 operands on the stack, 2 done
    std::vector<NodeId> stack;
    for (const NodeId root : original.roots) {
      stack.push_back(root);
      while (!stack.empty()) {
        const NodeId id = stack.back();
        if (state[id] == 2) {
          stack.pop_back();
        } else if (state[id] == 0) {
          state[id] = 1;
          const std::vector<Operand>& operands = nodes_[id].operands;
          for (auto it = operands.rbegin(); it != operands.rend(); ++it) {
            if (state[it->node] == 0) stack.push_back(it->node);
          }
        } else {
          state[id] = 2;
          stack.pop_back();
          image[id] = rebuilt(result.dag, original.dag, id, image);
        }
      }
      result.roots.push_back(image[root]);
    }
    return result;
  }

 private:
  struct Later {
    bool operator()(const std::pair<int, Pair>& x, const std::pair<int, Pair>& y) const {
      return std::tuple(x.first, y.second.a, y.second.b, y.second.ratio) <
             std::tuple(y.first, x.second.a, x.second.b, x.second.ratio);
    }
  };

  bool takes_part(NodeId id) const {
    const Node& node = nodes_[id];
    return node.kind == kind_ && node.stage >= from_ && node.operands.size() <= longest_sum &&
           (id >= needed_.size() || needed_[id]);
  }

  /// Whether two operands of one node may pair; sets the pair.
  bool pair_of(Operand x, Operand y, Pair& pair) const {
    if (nodes_[x.node].stage != nodes_[y.node].stage) return false;
    if (x.node > y.node) std::swap(x, y);
    if (kind_ == Kind::product) {
      if (x.factor != y.factor) return false;
      const auto [numerator, denominator] = exponent_of(numbers_, x.factor);
      if (denominator != 1 || numerator < 1) return false;
      pair = {x.node, y.node, NumberPool::one};
    } else {
      pair = {x.node, y.node, numbers_.multiply(y.factor, numbers_.inverse(x.factor))};
    }
    return true;
  }

  void change_count(const Pair& pair, int change) {
    int& count = counts_[pair];
    count += change;
    if (running_ && count > 1) queue_.emplace(count, pair);
  }

  void count_pairs(NodeId id, int change) {
    const std::vector<Operand>& operands = nodes_[id].operands;
    Pair pair{};
    for (std::size_t i = 0; i < operands.size(); ++i) {
      for (std::size_t j = i + 1; j < operands.size(); ++j) {
        if (pair_of(operands[i], operands[j], pair)) change_count(pair, change);
      }
    }
  }

  void count_pairs_with(NodeId id, const Operand& operand, int change) {
    Pair pair{};
    for (const Operand& other : nodes_[id].operands) {
      if (other.node != operand.node && pair_of(operand, other, pair)) change_count(pair, change);
    }
  }

  static const Operand* find(const Node& node, NodeId operand) {
    for (const Operand& candidate : node.operands) {
      if (candidate.node == operand) return &candidate;
    }
    return nullptr;
  }

  void take_out(const Pair& pair) {
    running_ = true;
    std::vector<NodeId> users;
    NodeId shared = 0;
    bool exists = false;
    for (const NodeId id : holders_[pair.a]) {
      const Operand* a = find(nodes_[id], pair.a);
      const Operand* b = find(nodes_[id], pair.b);
      Pair found{};
      if (a == nullptr || b == nullptr || !pair_of(*a, *b, found) || !(found == pair)) continue;
      const bool is_pair_itself = nodes_[id].operands.size() == 2 &&
                                  nodes_[id].value == NumberPool::zero &&
                                  a->factor == NumberPool::one;
      if (is_pair_itself && !exists) {
        shared = id;
        exists = true;
      } else {
        users.push_back(id);
      }
    }
    std::sort(users.begin(), users.end());
    users.erase(std::unique(users.begin(), users.end()), users.end());
    if (!exists) {
      Node node;
      node.kind = kind_;
      node.stage = nodes_[pair.a].stage;
      node.operands = {{pair.a, NumberPool::one}, {pair.b, pair.ratio}};
      shared = static_cast<NodeId>(nodes_.size());
      nodes_.push_back(std::move(node));
      holders_.emplace_back();
      holders_[pair.a].push_back(shared);
      holders_[pair.b].push_back(shared);
    }
    for (const NodeId id : users) {
      const Operand a = *find(nodes_[id], pair.a);
      const Operand b = *find(nodes_[id], pair.b);
      count_pairs_with(id, a, -1);
      std::erase(nodes_[id].operands, a);
      count_pairs_with(id, b, -1);
      std::erase(nodes_[id].operands, b);
      const Operand replacement{shared, a.factor};
      nodes_[id].operands.push_back(replacement);
      holders_[shared].push_back(id);
      count_pairs_with(id, replacement, +1);
    }
    counts_.erase(pair);
  }

  NodeId rebuilt(Dag& dag, const Dag& original, NodeId id, const std::vector<NodeId>& image) const {
    Node node = nodes_[id];
    for (Operand& operand : node.operands) operand.node = image[operand.node];
    if (node.kind == Kind::symbol) return dag.symbol(original.symbol_name(id), node.stage);
    const bool touched = node.stage >= from_;
    if (touched && node.kind == Kind::sum) return dag.sum(std::move(node.operands), node.value);
    if (touched && node.kind == Kind::product && !is_multiple(dag, node)) {
      return dag.product_of_groups(std::move(node.operands));
    }
    return dag.intern(std::move(node));
  }

  NumberPool& numbers_;
  Stage from_;
  Kind kind_ = Kind::product;
  bool running_ = false;
  std::vector<Node> nodes_;
  std::vector<bool> needed_;
  std::vector<std::vector<NodeId>> holders_;
  std::unordered_map<Pair, int, PairHash> counts_;
  std::priority_queue<std::pair<int, Pair>, std::vector<std::pair<int, Pair>>, Later> queue_;
};

}  // namespace

Graph share_pairs(const Graph& graph, Stage from) {
  Sharing sharing(graph, from);
  sharing.share(Kind::product);
  sharing.share(Kind::sum);
  return sharing.rebuild(graph);
}

}  // namespace elastogen::symgen
