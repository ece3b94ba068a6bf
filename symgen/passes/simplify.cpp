#include "symgen/passes/simplify.h"

#include <algorithm>

#include "symgen/passes/balance_numbers.h"
#include "symgen/passes/factor.h"
#include "symgen/passes/group_stages.h"
#include "symgen/passes/share_pairs.h"

namespace elastogen::symgen {

Graph simplified(Graph graph, Stage share_from, StageLog& log) {
  const auto end = [&](const char* stage) {
    const std::vector<bool> needed = graph.dag.reachable(graph.roots);
    log.end(stage, static_cast<std::size_t>(std::count(needed.begin(), needed.end(), true)));
  };
  graph = factor(graph);
  end("factor");
  graph = group_stages(graph);
  end("group_stages");
  graph = share_pairs(graph, share_from);
  end("share_pairs");
  graph = balance_numbers(graph);
  end("balance_numbers");
  return graph;
}

}  // namespace elastogen::symgen
