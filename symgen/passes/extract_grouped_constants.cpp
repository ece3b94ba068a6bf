#include "symgen/passes/extract_grouped_constants.h"

#include <algorithm>
#include <limits>
#include <queue>

#include "symgen/passes/cost.h"

namespace elastogen::symgen {
namespace {

/// Dinic's maximum flow, enough to split a graph into source side and sink side.
class MaximumFlow {
 public:
  int add_vertex() {
    edges_of_.emplace_back();
    return static_cast<int>(edges_of_.size()) - 1;
  }
  void add_edge(int from, int to, double capacity) {
    edges_of_[from].push_back(static_cast<int>(edges_.size()));
    edges_.push_back({to, capacity});
    edges_of_[to].push_back(static_cast<int>(edges_.size()));
    edges_.push_back({from, 0.0});
  }
  void run(int source, int sink) {
    while (find_levels(source, sink)) {
      next_.assign(edges_of_.size(), 0);
      while (push(source, sink, std::numeric_limits<double>::infinity()) > 0) {
      }
    }
  }
  /// After run: whether the vertex lies on the source's side of the minimum cut.
  [[nodiscard]] bool on_source_side(int vertex) const { return level_[vertex] >= 0; }

 private:
  struct Edge {
    int to;
    double capacity;
  };
  static constexpr double negligible = 1e-9;

  bool find_levels(int source, int sink) {
    level_.assign(edges_of_.size(), -1);
    level_[source] = 0;
    std::queue<int> queue;
    queue.push(source);
    while (!queue.empty()) {
      const int v = queue.front();
      queue.pop();
      for (const int e : edges_of_[v]) {
        if (edges_[e].capacity > negligible && level_[edges_[e].to] < 0) {
          level_[edges_[e].to] = level_[v] + 1;
          queue.push(edges_[e].to);
        }
      }
    }
    return level_[sink] >= 0;
  }

  double push(int v, int sink, double limit) {
    if (v == sink) return limit;
    for (std::size_t& k = next_[v]; k < edges_of_[v].size(); ++k) {
      const int e = edges_of_[v][k];
      const int to = edges_[e].to;
      if (edges_[e].capacity <= negligible || level_[to] != level_[v] + 1) continue;
      const double pushed = push(to, sink, std::min(limit, edges_[e].capacity));
      if (pushed > 0) {
        edges_[e].capacity -= pushed;
        edges_[e ^ 1].capacity += pushed;
        return pushed;
      }
    }
    return 0;
  }

  std::vector<Edge> edges_;
  std::vector<std::vector<int>> edges_of_;
  std::vector<int> level_;
  std::vector<std::size_t> next_;
};

bool is_candidate(const Node& node, Stage stage) {
  return node.stage <= stage && node.kind != Kind::number;
}

/// Nodes of stage `stage` that later nodes read (or that are roots themselves).
std::vector<bool> read_later(const Dag& dag, std::span<const NodeId> roots, Stage stage,
                             const std::vector<bool>& needed) {
  std::vector<bool> read(needed.size(), false);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Node& node = dag[static_cast<NodeId>(i)];
    if (!needed[i] || node.stage <= stage) continue;
    for (const Operand& operand : node.operands) {
      if (is_candidate(dag[operand.node], stage)) read[operand.node] = true;
    }
  }
  for (const NodeId root : roots) {
    if (is_candidate(dag[root], stage)) read[root] = true;
  }
  return read;
}

bool is_parameter(const Node& node) {
  return node.kind == Kind::symbol && node.stage == Stage::material;
}

}  // namespace

std::vector<NodeId> algorithm6(const Dag& dag, std::span<const NodeId> roots, Stage stage) {
  const std::vector<bool> needed = dag.reachable(roots);
  std::vector<bool> read = read_later(dag, roots, stage, needed);
  for (std::size_t i = read.size(); i-- > 0;) {  // what multiples are of stands for them
    const Node& node = dag[static_cast<NodeId>(i)];
    if (!read[i] || !is_multiple(dag, node)) continue;
    read[i] = false;
    for (const Operand& operand : node.operands) {
      if (dag[operand.node].kind != Kind::number) read[operand.node] = true;
    }
  }
  std::vector<NodeId> stored;
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (read[i] && !is_parameter(dag[static_cast<NodeId>(i)])) {
      stored.push_back(static_cast<NodeId>(i));
    }
  }
  return stored;
}

std::vector<NodeId> minimum_cut(const Dag& dag, std::span<const NodeId> roots, Stage stage,
                                const CutPrices& prices) {
  const std::vector<bool> needed = dag.reachable(roots);
  const std::vector<bool> read = read_later(dag, roots, stage, needed);
  constexpr double unbounded = 1e12;

  // Two decisions per node: its value is available; it is recomputed rather than read. Selecting
  // "recomputed" saves its price, costs its time, and needs its operands available.
  MaximumFlow flow;
  const int source = flow.add_vertex(), sink = flow.add_vertex();
  std::vector<int> available(needed.size(), -1), recomputed(needed.size(), -1);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i] && is_candidate(dag[static_cast<NodeId>(i)], stage)) {
      available[i] = flow.add_vertex();
      recomputed[i] = flow.add_vertex();
    }
  }
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (available[i] < 0) continue;
    const NodeId id = static_cast<NodeId>(i);
    const Node& node = dag[id];
    const bool is_position = node.kind == Kind::symbol && node.stage == Stage::rest;
    // At stage state the grouped constants and positions are inputs of both kernels alike.
    const bool is_free = is_parameter(node) || (stage == Stage::state && node.stage <= Stage::rest);
    const double price = is_free ? 0.0 : is_position ? prices.position : prices.stored;
    if (!read[i]) flow.add_edge(available[i], sink, price);
    if (node.kind == Kind::symbol || is_free) continue;
    const double gain = price - cost_of(dag, id).time();
    if (gain > 0) {
      flow.add_edge(source, recomputed[i], gain);
    } else {
      flow.add_edge(recomputed[i], sink, -gain);
    }
    flow.add_edge(recomputed[i], available[i], unbounded);
    for (const Operand& operand : node.operands) {
      if (available[operand.node] >= 0) {
        flow.add_edge(recomputed[i], available[operand.node], unbounded);
      }
    }
  }
  flow.run(source, sink);

  std::vector<NodeId> stored;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (available[i] < 0) continue;
    const NodeId id = static_cast<NodeId>(i);
    const bool is_available = read[i] || flow.on_source_side(available[i]);
    const bool is_input = dag[id].kind == Kind::symbol && dag[id].stage <= Stage::rest;
    const bool is_constant_of_state = stage == Stage::state && dag[id].stage <= Stage::rest;
    if (is_available && !flow.on_source_side(recomputed[i]) && !is_input && !is_constant_of_state) {
      stored.push_back(id);
    }
  }
  return stored;
}

}  // namespace elastogen::symgen
