#include "runtime/solver_choice.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace elastogen {
namespace {

/// Nodes to elements and back, for walks over the mesh.
class NodeWalk {
 public:
  explicit NodeWalk(const Mesh& mesh);

  /// Widths of the layers around `start`, appended; `layer` gets a number > 0 for each node
  /// reached.
  /// @return a node of the last layer
  std::int32_t layers_from(std::int32_t start, std::vector<std::int32_t>& layer,
                           std::vector<double>& widths);

 private:
  std::vector<std::size_t> element_begins_{0};  // [element] into nodes_
  std::vector<std::int32_t> nodes_;             // of the elements
  std::vector<std::size_t> node_begins_;        // [node] into elements_
  std::vector<std::int32_t> elements_;          // of the nodes
  std::vector<std::int32_t> visited_;           // [element] walk that came by
  std::int32_t walk_ = 0;
};

NodeWalk::NodeWalk(const Mesh& mesh) : node_begins_(mesh.num_nodes() + 1, 0) {
  for (const ElementBlock& block : mesh.blocks) {
    const auto size = static_cast<std::size_t>(block.nodes_per_element);
    for (std::size_t first = 0; first < block.nodes.size(); first += size) {
      element_begins_.push_back(element_begins_.back() + size);
    }
    nodes_.insert(nodes_.end(), block.nodes.begin(), block.nodes.end());
  }
  for (const std::int32_t node : nodes_) ++node_begins_[static_cast<std::size_t>(node) + 1];
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    node_begins_[node + 1] += node_begins_[node];
  }
  elements_.resize(nodes_.size());
  std::vector<std::size_t> next(node_begins_.begin(), node_begins_.end() - 1);
  for (std::size_t e = 0; e + 1 < element_begins_.size(); ++e) {
    for (std::size_t k = element_begins_[e]; k < element_begins_[e + 1]; ++k) {
      elements_[next[static_cast<std::size_t>(nodes_[k])]++] = static_cast<std::int32_t>(e);
    }
  }
  visited_.assign(element_begins_.size() - 1, 0);
}

std::int32_t NodeWalk::layers_from(std::int32_t start, std::vector<std::int32_t>& layer,
                                   std::vector<double>& widths) {
  ++walk_;
  std::int32_t number = 1;
  layer[static_cast<std::size_t>(start)] = number;
  std::vector<std::int32_t> front = {start}, next;
  std::int32_t last = start;
  while (!front.empty()) {
    widths.push_back(static_cast<double>(front.size()));
    last = front.back();
    ++number;
    next.clear();
    for (const std::int32_t node : front) {
      const auto n = static_cast<std::size_t>(node);
      for (std::size_t i = node_begins_[n]; i < node_begins_[n + 1]; ++i) {
        const auto e = static_cast<std::size_t>(elements_[i]);
        if (visited_[e] == walk_) continue;
        visited_[e] = walk_;
        for (std::size_t k = element_begins_[e]; k < element_begins_[e + 1]; ++k) {
          std::int32_t& mark = layer[static_cast<std::size_t>(nodes_[k])];
          if (mark != 0) continue;
          mark = number;
          next.push_back(nodes_[k]);
        }
      }
    }
    std::swap(front, next);
  }
  return last;
}

}  // namespace

LayeredShape layered_shape(const Mesh& mesh) {
  const auto dim = static_cast<double>(mesh.dim);
  LayeredShape shape;
  shape.num_dofs = dim * static_cast<double>(mesh.num_nodes());
  bool is_quadratic = false;
  for (const ElementBlock& block : mesh.blocks) {
    const double nodes = block.nodes_per_element;
    // A force at each node from each, and the laws' own work, which is about as much.
    shape.product_operations += 2 * dim * dim * nodes * static_cast<double>(block.nodes.size());
    is_quadratic = is_quadratic || nodes > (mesh.dim == 3 ? 8 : 4);
  }
  NodeWalk walk(mesh);
  std::vector<std::int32_t> ends(mesh.num_nodes(), 0), layer(mesh.num_nodes(), 0);
  double most_layers = 0;
  std::vector<double> first_widths, widths;
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    if (layer[node] != 0) continue;
    first_widths.clear();
    widths.clear();
    const std::int32_t end = walk.layers_from(static_cast<std::int32_t>(node), ends, first_widths);
    (void)walk.layers_from(end, layer, widths);
    most_layers = std::max(most_layers, static_cast<double>(widths.size()));
    for (const double width : widths) {
      // Within wide layers a good order finds gaps.
      const double filled = std::min(1.0, 2.2 / std::sqrt(width));
      shape.multiplications += filled * std::pow(dim * width, 3);
      shape.factor_entries += std::min(1.0, 2 * filled) * std::pow(dim * width, 2);
    }
  }
  const double mean_width = static_cast<double>(mesh.num_nodes()) / std::max(most_layers, 1.0);
  shape.thickness = mesh.dim == 3 ? std::sqrt(mean_width) : mean_width;
  shape.num_layers = (is_quadratic ? 2 : 1) * most_layers;
  return shape;
}

namespace {

// Costs in nanoseconds of a core of 2020; only their ratios matter.
constexpr double operation = 0.04;             // of kernels, several at once
constexpr double column_multiplication = 0.8;  // of a factorisation column by column
constexpr double block_multiplication = 0.1;   // by dense blocks
constexpr double most_by_columns = 5e7;        // multiplications
constexpr double entry = 1.2;                  // of a factor, forwards and backwards
constexpr double dof = 6;                      // of conjugate gradient's vectors, per iteration
constexpr double assembly = 12;                // products

struct Costs {
  double product, factorization, substitution;
};

Costs costs_of(const LayeredShape& shape) {
  Costs costs{};
  costs.product = operation * shape.product_operations + dof * shape.num_dofs;
  const bool by_columns = shape.multiplications < most_by_columns;
  costs.factorization =
      shape.multiplications * (by_columns ? column_multiplication : block_multiplication) +
      assembly * costs.product;
  costs.substitution = entry * shape.factor_entries;
  return costs;
}

struct Candidate {
  LinearSolverKind kind;
  double cost;
};

std::string size_text(const LayeredShape& shape) {
  return fmt::format("{:.0f} degrees of freedom in about {:.0f} layers {:.0f} nodes thick",
                     shape.num_dofs, shape.num_layers, shape.thickness);
}

}  // namespace

double memory_for_factor() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

SolverChoice choose_linear_solver(const Mesh& mesh, SolverTask task, double memory) {
  const LayeredShape shape = layered_shape(mesh);
  const Costs costs = costs_of(shape);
  // Bending has the condition (layers * slenderness)^2, and conjugate gradient its root.
  const double slenderness = std::max(1.0, shape.num_layers / shape.thickness);
  const bool is_static = task == SolverTask::equilibrium;
  const double iterations = is_static ? 7.5 * shape.num_layers * slenderness : 150;
  const double factored = costs.product + costs.substitution;  // an iteration with a factor
  const double cg = iterations * costs.product;
  std::vector<Candidate> candidates = {{LinearSolverKind::conjugate_gradient, cg}};
  const double factor_bytes = 2 * sizeof(double) * shape.factor_entries;
  const bool fits = factor_bytes <= memory;
  if (fits && is_static) {
    candidates.push_back(
        {LinearSolverKind::cholesky_cg, 1.5 * costs.factorization + 30 * factored});
    candidates.push_back(
        {LinearSolverKind::cholesky, 6 * (costs.factorization + costs.substitution)});
  } else if (fits) {
    candidates.push_back({LinearSolverKind::cholesky_cg, costs.factorization / 20 + 6 * factored});
    candidates.push_back({LinearSolverKind::cholesky, costs.factorization + costs.substitution});
  }
  const auto cheaper = [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; };
  const Candidate best = *std::min_element(candidates.begin(), candidates.end(), cheaper);

  SolverChoice choice;
  choice.kind = best.kind;
  if (!fits) {
    choice.reason = fmt::format("{}: a factor of about {:.1f} GB is more than half of the memory",
                                size_text(shape), 1e-9 * factor_bytes);
  } else if (best.kind == LinearSolverKind::conjugate_gradient) {
    choice.reason = fmt::format(
        "{}: so thick that a factorisation, of about {:.1e} multiplications, costs more than "
        "iterations",
        size_text(shape), shape.multiplications);
  } else {
    choice.reason = fmt::format(
        "{}: a factorisation, of about {:.1e} multiplications, costs less than the {:.0f} "
        "iterations to expect without{}",
        size_text(shape), shape.multiplications, iterations, is_static ? "" : " in each step");
  }
  if (best.kind == LinearSolverKind::conjugate_gradient && fits) {
    choice.fall_back_after = static_cast<int>(std::max(500.0, iterations));
  }
  choice.factorize_for_stability = fits && costs.factorization < 0.05 * cg;
  return choice;
}

}  // namespace elastogen
