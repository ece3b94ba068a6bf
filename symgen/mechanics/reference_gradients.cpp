#include "symgen/mechanics/reference_gradients.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "symgen/dag/lower.h"

namespace elastogen::symgen {
namespace {

using ExactMatrix = std::vector<std::vector<ExactNumber>>;  // [node][reference coordinate]

/// Gradients of the shape functions in reference coordinates at a point.
ExactMatrix shape_gradients(const Element& element, const std::vector<GiNaC::ex>& point) {
  std::map<GiNaC::ex, ExactNumber, GiNaC::ex_is_less> values;
  for (int k = 0; k < element.dim; ++k) {
    values[element.coordinates[k]] = exact_value(point[k], {});
  }
  ExactMatrix gradients;
  for (const GiNaC::ex& shape : element.shape_functions) {
    std::vector<ExactNumber> row;
    for (const GiNaC::symbol& coordinate : element.coordinates) {
      row.push_back(exact_value(shape.diff(coordinate), values));
    }
    gradients.push_back(std::move(row));
  }
  return gradients;
}

/// How nodes come together along one reference coordinate: nodes whose coefficients are opposite at
/// every quadrature point are pairs (the edges of a hexahedron); others, unless theirs vanish, are
/// alone.
struct NodePairs {
  std::vector<Difference> pairs;
  std::vector<int> alone;  // ascending
};

NodePairs pair_nodes(const std::vector<ExactMatrix>& gradients, int k) {
  const int num_nodes = static_cast<int>(gradients[0].size());
  const auto opposite = [&](int a, int b) {
    for (const ExactMatrix& at_point : gradients) {
      if (!(at_point[a][k] == -at_point[b][k])) return false;
    }
    return true;
  };
  const auto vanishes = [&](int a) {
    for (const ExactMatrix& at_point : gradients) {
      if (!at_point[a][k].is_zero()) return false;
    }
    return true;
  };
  NodePairs result;
  std::vector<bool> done(num_nodes, false);
  for (int a = 0; a < num_nodes; ++a) {
    if (done[a] || vanishes(a)) continue;
    for (int b = a + 1; b < num_nodes && !done[a]; ++b) {
      if (done[b] || !opposite(a, b)) continue;
      result.pairs.push_back({a, b});
      done[a] = done[b] = true;
    }
    if (!done[a]) result.alone.push_back(a);
  }
  return result;
}

/// Since the gradients of a partition of unity add up to zero, sum_a c_a U_a may be written with
/// differences of U only: those of pairs, and of nodes that are alone from one of them. This one is
/// the same along all coordinates where there is such a node: its differences are shared then.
/// @return [reference coordinate]
std::vector<std::vector<Difference>> nodal_differences(const std::vector<ExactMatrix>& gradients,
                                                       int dim) {
  std::vector<NodePairs> along;
  for (int k = 0; k < dim; ++k) along.push_back(pair_nodes(gradients, k));
  std::vector<int> common = along[0].alone;
  for (const NodePairs& each : along) {
    std::erase_if(common, [&](int a) {
      return !std::binary_search(each.alone.begin(), each.alone.end(), a);
    });
  }
  std::vector<std::vector<Difference>> differences;
  for (NodePairs& each : along) {
    std::vector<Difference>& result = differences.emplace_back(std::move(each.pairs));
    if (each.alone.empty()) continue;
    const int reference = common.empty() ? each.alone.back() : common.back();
    for (const int a : each.alone) {
      if (a != reference) result.push_back({a, reference});
    }
  }
  return differences;
}

}  // namespace

std::string nodal_name(const std::string& field, int node, int i) {
  return fmt::format("{}{}.{}", field, node, "xyz"[i]);
}

std::string gradient_name(const std::string& field, int i, int k) {
  return fmt::format("d{}.{}/dxi{}", field, "xyz"[i], k);
}

std::string flux_name(std::size_t point, std::size_t entry) {
  return fmt::format("F{}.{}", point, entry);
}

std::vector<NodeId> nodal_inputs(Dag& dag, const std::string& field, const Element& element,
                                 Stage stage) {
  std::vector<NodeId> inputs;
  for (int a = 0; a < element.num_nodes(); ++a) {
    for (int i = 0; i < element.dim; ++i) {
      inputs.push_back(dag.symbol(nodal_name(field, a, i), stage));
    }
  }
  return inputs;
}

NodeMatrix gradient_inputs(Dag& dag, const std::string& field, int dim, Stage stage) {
  NodeMatrix inputs(dim, std::vector<NodeId>(dim));
  for (int i = 0; i < dim; ++i) {
    for (int k = 0; k < dim; ++k) {
      inputs[i][k] = dag.symbol(gradient_name(field, i, k), stage);
    }
  }
  return inputs;
}

ReferenceGradients::ReferenceGradients(const Element& element, const Quadrature& quadrature)
    : dim_(element.dim) {
  for (const std::vector<GiNaC::ex>& point : quadrature.points) {
    gradients_.push_back(shape_gradients(element, point));
  }
  differences_ = nodal_differences(gradients_, element.dim);
}

NodeMatrix ReferenceGradients::of(Dag& dag, const std::vector<NodeId>& field, int g) const {
  NodeMatrix result(dim_, std::vector<NodeId>(dim_));
  for (int i = 0; i < dim_; ++i) {
    for (int k = 0; k < dim_; ++k) {
      std::vector<Operand> terms;
      for (const auto& [node, other] : differences_[k]) {
        const NumberId coefficient = dag.numbers().intern(gradients_[g][node][k]);
        if (coefficient == NumberPool::zero) continue;
        terms.push_back(
            {dag.subtract(field[node * dim_ + i], field[other * dim_ + i]), coefficient});
      }
      result[i][k] = dag.sum(std::move(terms));
    }
  }
  return result;
}

NodeMatrix ReferenceGradients::coefficients(Dag& dag, int g) const {
  NodeMatrix coefficients(differences_.size());
  for (std::size_t k = 0; k < differences_.size(); ++k) {
    for (const Difference& difference : differences_[k]) {
      coefficients[k].push_back(dag.number(gradients_[g][difference.node][k]));
    }
  }
  return coefficients;
}

}  // namespace elastogen::symgen
