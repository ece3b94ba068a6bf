#include "runtime/node_numbering.h"

#include <algorithm>

namespace elastogen {

template <class Scalar>
NodeNumbering::NodeNumbering(std::vector<ElementGroup<Scalar>>& groups, std::size_t num_nodes) {
  constexpr std::int32_t none = -1;
  std::vector<std::int32_t> numbers(num_nodes, none);
  for (ElementGroup<Scalar>& group : groups) {
    for (std::int32_t& dof : group.dofs) {
      const std::int32_t node = dof / group.dim;
      std::int32_t& number = numbers[static_cast<std::size_t>(node)];
      if (number == none) {
        number = static_cast<std::int32_t>(nodes_.size());
        nodes_.push_back(node);
      }
      dof = number * group.dim;
    }
  }
}

// Calls `function(number, node)` for every node, in parallel; both count values. Asks for the
// vector's values early: nothing foresees where they are.
template <class Function>
void NodeNumbering::for_each_node(const double* vector, int values_per_node, int threads,
                                  Function&& function) const {
  constexpr std::ptrdiff_t ahead = 32;
  const auto count = static_cast<std::ptrdiff_t>(nodes_.size());
  const std::int32_t* const nodes = nodes_.data();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t number = 0; number < count; ++number) {
    const std::ptrdiff_t later = nodes[std::min(number + ahead, count - 1)];
    __builtin_prefetch(vector + later * values_per_node);
    function(number * values_per_node,
             static_cast<std::ptrdiff_t>(nodes[number]) * values_per_node);
  }
}

void NodeNumbering::copy_from_mesh(const double* vector, int values_per_node, int threads,
                                   double* copy) const {
  for_each_node(vector, values_per_node, threads, [&](std::ptrdiff_t to, std::ptrdiff_t from) {
    for (int i = 0; i < values_per_node; ++i) copy[to + i] = vector[from + i];
  });
}

void NodeNumbering::add_to_mesh(const double* values, int values_per_node, int threads,
                                double* vector) const {
  for_each_node(vector, values_per_node, threads, [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    for (int i = 0; i < values_per_node; ++i) vector[to + i] += values[from + i];
  });
}

template NodeNumbering::NodeNumbering(std::vector<ElementGroup<double>>&, std::size_t);
template NodeNumbering::NodeNumbering(std::vector<ElementGroup<float>>&, std::size_t);

}  // namespace elastogen
