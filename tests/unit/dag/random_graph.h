// Random expression graphs, the same for the same seed.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

struct RandomGraph {
  Graph graph;
  std::map<NodeId, double> values;  ///< of the symbols, away from zero
};

/// Sums, products (with powers and reciprocals) and functions of positive arguments over symbols of
/// every stage; a few roots.
[[nodiscard]] RandomGraph make_random_graph(std::uint32_t seed, int num_nodes = 60);

/// Values of the roots of a graph whose symbols have the names of `reference`'s.
[[nodiscard]] std::vector<double> values_of(const Graph& graph, const RandomGraph& reference);

}  // namespace elastogen::symgen
