#include "runtime/element_group.h"

#include <algorithm>
#include <numeric>

#include "runtime/congruent_elements.h"

namespace elastogen {
namespace {

// Elements whose batches stand together: nodes that a batch's lanes share are still in cache.
constexpr std::size_t block_size = 1024;

// Position of each element of a group in its batches: full batches interleaved block by block, the
// rest in order, empty lanes repeat the last element.
std::vector<std::size_t> batch_order(std::size_t num_elements, std::size_t lanes) {
  std::vector<std::size_t> order;
  for (std::size_t begin = 0; begin < num_elements; begin += block_size) {
    interleave_lanes(std::min(block_size, num_elements - begin), lanes,
                     [&](std::size_t k) { order.push_back(begin + k); });
  }
  for (std::size_t k = order.size(); k < num_elements; ++k) order.push_back(k);
  while (order.size() % lanes != 0) order.push_back(num_elements - 1);
  return order;
}

/// Finds which orders the nodes stand in, unless it is their own everywhere.
template <class Scalar>
void keep_node_orders(const ElementGroupSource<Scalar>& source,
                      const std::vector<std::size_t>& order, ElementGroup<Scalar>& group) {
  if (source.node_order.empty()) return;
  const auto nodes = static_cast<std::size_t>(group.num_nodes);
  std::vector<int> own(nodes);
  std::iota(own.begin(), own.end(), 0);
  for (const std::size_t k : order) {
    const auto its = source.node_order.subspan(k * nodes, nodes);
    auto known = std::find_if(group.node_orders.begin(), group.node_orders.end(),
                              [&](const std::vector<int>& known_order) {
                                return std::equal(its.begin(), its.end(), known_order.begin());
                              });
    if (known == group.node_orders.end()) {
      known = group.node_orders.emplace(known, its.begin(), its.end());
    }
    group.turn.push_back(static_cast<std::uint8_t>(known - group.node_orders.begin()));
  }
  if (group.node_orders.size() == 1 && group.node_orders.front() == own) {
    group.node_orders.clear();
    group.turn.clear();
  }
}

std::size_t num_shapes(const std::vector<std::int32_t>& shape) {
  return static_cast<std::size_t>(*std::max_element(shape.begin(), shape.end())) + 1;
}

}  // namespace

template <class Scalar>
std::size_t ElementGroup<Scalar>::bytes_per_element() const {
  const std::size_t connectivity = static_cast<std::size_t>(num_nodes) * sizeof(std::int32_t);
  if (at_rest) return connectivity;
  const std::size_t vectors =
      kernels->reads_positions ? static_cast<std::size_t>(num_nodes * dim) : 0;
  const std::size_t per_set = vectors + static_cast<std::size_t>(kernels->num_constants);
  const std::size_t stored_state = state.empty() ? 0 : static_cast<std::size_t>(kernels->num_state);
  const std::size_t from_set =
      shape.empty() ? per_set : num_sets * static_cast<std::size_t>(lanes) * per_set / num_elements;
  return connectivity + (from_set + stored_state) * sizeof(Scalar);
}

template <class Scalar>
NodalPass<Scalar> ElementGroup<Scalar>::nodal_pass() const {
  const std::size_t l = static_cast<std::size_t>(lanes);
  NodalPass<Scalar> pass;
  pass.arguments = arguments_of_set(0, 0);
  pass.batches_at_once = kernels->batches_at_once;
  pass.positions_stride = values_per_batch();
  pass.constants_stride = static_cast<std::size_t>(kernels->num_constants) * l;
  pass.state_stride = static_cast<std::size_t>(kernels->num_state) * l;
  pass.shape = shape.empty() ? nullptr : shape.data();
  pass.dofs = dofs.data();
  pass.begin = 0;
  pass.end = num_batches;
  pass.num_elements = num_elements;
  return pass;
}

template <class Scalar>
KernelArguments<Scalar> ElementGroup<Scalar>::arguments_of_set(std::size_t set,
                                                               std::size_t batch) const {
  const std::size_t l = static_cast<std::size_t>(lanes);
  KernelArguments<Scalar> result;
  if (!positions.empty()) result.positions = positions.data() + set * values_per_batch();
  result.parameters = parameters.data();
  result.constants = constants.data() + set * static_cast<std::size_t>(kernels->num_constants) * l;
  if (!state.empty()) {
    result.state = state.data() + batch * static_cast<std::size_t>(kernels->num_state) * l;
  }
  return result;
}

template <class Scalar>
ElementGroup<Scalar> make_element_group(const Mesh& mesh,
                                        const ElementGroupSource<Scalar>& source) {
  const ElementBlock& block = mesh.blocks[source.block];
  ElementGroup<Scalar> group;
  group.part = source.part;
  group.block = source.block;
  group.at_rest = source.at_rest;
  group.table = source.table;
  group.kernels = source.kernels;
  group.dim = mesh.dim;
  group.num_nodes = source.table->num_nodes;
  group.lanes = source.table->lanes;
  group.density = source.density;
  group.numbers = mesh.numbers;
  for (const double p : source.parameters) group.parameters.push_back(static_cast<Scalar>(p));
  group.num_elements = source.elements.size();

  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  const std::size_t dim = static_cast<std::size_t>(group.dim);
  std::vector<std::size_t> order(group.num_elements);
  if (source.shape.empty()) {
    order = batch_order(group.num_elements, lanes);
  } else {
    std::iota(order.begin(), order.end(), std::size_t{0});
    group.shape.assign(source.shape.begin(), source.shape.end());
  }
  group.num_batches = order.size() / lanes;
  group.num_sets = group.shape.empty() ? group.num_batches : num_shapes(group.shape);
  group.elements.resize(order.size());
  group.dofs.resize(order.size() * nodes);
  keep_node_orders(source, order, group);
  group.positions.resize(group.num_sets * lanes * nodes * dim);
  std::vector<bool> is_known(group.num_sets, false);
  for (std::size_t batch = 0; batch < group.num_batches; ++batch) {
    const std::size_t set = group.set_of(batch);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t k = batch * lanes + lane;
      const std::size_t e = static_cast<std::size_t>(source.elements[order[k]]);
      group.elements[k] = static_cast<std::int32_t>(source.first_element + e);
      const std::span<const std::int32_t> element_nodes = block.element_nodes(e);
      // The lanes of a shared set are those of the first batch that has it.
      for (std::size_t a = 0; a < nodes; ++a) {
        const std::size_t own =
            source.node_order.empty()
                ? a
                : static_cast<std::size_t>(source.node_order[order[k] * nodes + a]);
        const std::int32_t dof = element_nodes[own] * group.dim;
        group.dofs[(batch * nodes + a) * lanes + lane] = dof;
        if (is_known[set]) continue;
        const auto first = static_cast<std::size_t>(group.dofs[batch * nodes * lanes + lane]);
        for (std::size_t i = 0; i < dim; ++i) {
          group.positions[((set * nodes + a) * dim + i) * lanes + lane] = static_cast<Scalar>(
              mesh.positions[static_cast<std::size_t>(dof) + i] - mesh.positions[first + i]);
        }
      }
    }
    is_known[set] = true;
  }
  return group;
}

template <class Scalar>
void compute_constants(ElementGroup<Scalar>& group, int threads) {
  if (group.at_rest) {
    group.positions = {};
    return;
  }
  const std::size_t per_set = static_cast<std::size_t>(group.kernels->num_constants) *
                              static_cast<std::size_t>(group.lanes);
  group.constants.resize(group.num_sets * per_set);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t set = 0; set < group.num_sets; ++set) {
    KernelArguments<Scalar> arguments = group.arguments_of_set(set, 0);
    arguments.output = group.constants.data() + set * per_set;
    group.kernels->constants(&arguments, 1);
  }
  if (!group.kernels->reads_positions) group.positions = {};
}

template <class Scalar>
ElementStatus batch_status(const ElementGroup<Scalar>& group, std::size_t batch,
                           const std::uint32_t* flags) {
  ElementStatus first;
  for (int l = 0; l < group.used_lanes(batch); ++l) {
    if (flags[l] == status_ok) continue;
    const std::size_t k =
        batch * static_cast<std::size_t>(group.lanes) + static_cast<std::size_t>(l);
    first.merge({flags[l], static_cast<std::size_t>(group.elements[k])});
  }
  return first;
}

template struct ElementGroup<double>;
template struct ElementGroup<float>;
template ElementGroup<double> make_element_group(const Mesh&, const ElementGroupSource<double>&);
template ElementGroup<float> make_element_group(const Mesh&, const ElementGroupSource<float>&);
template void compute_constants(ElementGroup<double>&, int);
template void compute_constants(ElementGroup<float>&, int);
template ElementStatus batch_status(const ElementGroup<double>&, std::size_t, const std::uint32_t*);
template ElementStatus batch_status(const ElementGroup<float>&, std::size_t, const std::uint32_t*);

}  // namespace elastogen
