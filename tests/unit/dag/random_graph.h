// Random expression graphs: the same for the same seed, or the same choices.
#pragma once

#include <cstdint>
#include <functional>
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

/// The same by somebody else's choices.
/// @param below  an index that is less than a bound
[[nodiscard]] RandomGraph make_graph(const std::function<std::size_t(std::size_t)>& below,
                                     int num_nodes);

/// Values of the roots of a graph whose symbols have the names of `reference`'s.
[[nodiscard]] std::vector<double> values_of(const Graph& graph, const RandomGraph& reference);

}  // namespace elastogen::symgen
