// Pictures of small graphs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "symgen/dag/dag.h"

namespace elastogen::symgen {

struct LabelledRoot {
  std::string label;  ///< "forces[0]"
  NodeId node;
};

/// The graph in Graphviz's language: nodes coloured by stage, `stored` ones doubly framed, factors
/// other than 1 on the edges.
[[nodiscard]] std::string print_dot(const Dag& dag, std::span<const LabelledRoot> roots,
                                    std::span<const NodeId> stored, const std::string& title);

}  // namespace elastogen::symgen
