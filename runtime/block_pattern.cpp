#include "runtime/block_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "runtime/error.h"

namespace elastogen {
namespace {

// Calls visit(group, lane index k, the mesh's numbers of that element's nodes) for every element.
template <class Scalar, class Visit>
void for_each_element(const std::vector<ElementGroup<Scalar>>& groups,
                      const NodeNumbering& numbering, Visit&& visit) {
  std::vector<std::int32_t> nodes;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const ElementGroup<Scalar>& group = groups[g];
    const std::size_t lanes = static_cast<std::size_t>(group.lanes);
    const std::size_t n = static_cast<std::size_t>(group.num_nodes);
    nodes.resize(n);
    for (std::size_t k = 0; k < group.num_elements; ++k) {
      for (std::size_t a = 0; a < n; ++a) {
        nodes[a] =
            numbering.node_of_mesh(group.dofs[(k / lanes * n + a) * lanes + k % lanes] / group.dim);
      }
      visit(g, k, nodes);
    }
  }
}

// Neighbours of each node (itself included), ascending.
template <class Scalar>
std::vector<std::vector<std::int32_t>> node_neighbours(
    const std::vector<ElementGroup<Scalar>>& groups, const NodeNumbering& numbering,
    std::size_t num_nodes) {
  std::vector<std::vector<std::int32_t>> neighbours(num_nodes);
  for_each_element(groups, numbering,
                   [&](std::size_t, std::size_t, const std::vector<std::int32_t>& nodes) {
                     for (const std::int32_t a : nodes) {
                       std::vector<std::int32_t>& list = neighbours[static_cast<std::size_t>(a)];
                       for (const std::int32_t b : nodes) {
                         const auto place = std::lower_bound(list.begin(), list.end(), b);
                         if (place == list.end() || *place != b) list.insert(place, b);
                       }
                     }
                   });
  return neighbours;
}

}  // namespace

template <class Scalar>
BlockPattern::BlockPattern(const std::vector<ElementGroup<Scalar>>& groups,
                           const NodeNumbering& numbering, std::size_t num_nodes, int dim) {
  const std::vector<std::vector<std::int32_t>> neighbours =
      node_neighbours(groups, numbering, num_nodes);
  std::size_t num_blocks = 0;
  for (const auto& list : neighbours) num_blocks += list.size();
  const std::size_t num_values = num_blocks * static_cast<std::size_t>(dim * dim);
  if (num_values > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError(fmt::format(
        "the assembled stiffness would have {} values, more than its 32-bit indices can number; "
        "use conjugate gradient with a product that is not assembled",
        num_values));
  }
  std::vector<std::int32_t> block_begin = {0};  // [node]: first block of its columns
  outer_.assign(1, 0);
  inner_.reserve(num_values);
  for (const auto& list : neighbours) {
    block_begin.push_back(block_begin.back() + static_cast<std::int32_t>(list.size()));
    for (int j = 0; j < dim; ++j) {
      for (const std::int32_t b : list) {
        for (int i = 0; i < dim; ++i) inner_.push_back(b * dim + i);
      }
      outer_.push_back(static_cast<std::int32_t>(inner_.size()));
    }
  }
  for (std::size_t number = 0; number < num_nodes; ++number) {
    const auto node =
        static_cast<std::size_t>(numbering.node_of_mesh(static_cast<std::int32_t>(number)));
    column_lengths_.push_back(static_cast<std::int32_t>(neighbours[node].size()) * dim);
  }

  for (const ElementGroup<Scalar>& group : groups) {
    const std::size_t n = static_cast<std::size_t>(group.num_nodes);
    slots_.emplace_back(group.num_elements * n * n);
  }
  for_each_element(groups, numbering, [&](std::size_t g, std::size_t k, const auto& nodes) {
    const std::size_t n = nodes.size();
    for (std::size_t a = 0; a < n; ++a) {
      const std::size_t node = static_cast<std::size_t>(nodes[a]);
      const auto& list = neighbours[node];
      for (std::size_t b = 0; b < n; ++b) {
        const auto place = std::lower_bound(list.begin(), list.end(), nodes[b]);
        slots_[g][(k * n + a) * n + b] =
            block_begin[node] * dim * dim + static_cast<std::int32_t>(place - list.begin()) * dim;
      }
    }
  });
}

void BlockPattern::shape(Eigen::SparseMatrix<double>& matrix) const {
  const Eigen::Index size = static_cast<Eigen::Index>(outer_.size()) - 1;
  const auto values = static_cast<Eigen::Index>(inner_.size());
  if (matrix.rows() == size && matrix.cols() == size && matrix.isCompressed() &&
      matrix.nonZeros() == values &&
      std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr()) &&
      std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr())) {
    return;
  }
  matrix.resize(size, size);
  matrix.resizeNonZeros(values);
  std::copy(outer_.begin(), outer_.end(), matrix.outerIndexPtr());
  std::copy(inner_.begin(), inner_.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), values, 0.0);
}

template BlockPattern::BlockPattern(const std::vector<ElementGroup<double>>&, const NodeNumbering&,
                                    std::size_t, int);
template BlockPattern::BlockPattern(const std::vector<ElementGroup<float>>&, const NodeNumbering&,
                                    std::size_t, int);

}  // namespace elastogen
