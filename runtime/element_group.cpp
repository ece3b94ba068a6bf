#include "runtime/element_group.h"

namespace elastogen {
namespace {

// Position of each element of a group in its batches: full batches interleaved, the rest in order,
// empty lanes repeat the last element.
std::vector<std::size_t> batch_order(std::size_t num_elements, std::size_t lanes) {
  const std::size_t full = num_elements / lanes;
  const std::size_t batches = (num_elements + lanes - 1) / lanes;
  std::vector<std::size_t> order(batches * lanes);
  for (std::size_t b = 0; b < full; ++b) {
    for (std::size_t l = 0; l < lanes; ++l) order[b * lanes + l] = l * full + b;
  }
  for (std::size_t k = full * lanes; k < order.size(); ++k) {
    order[k] = k < num_elements ? k : num_elements - 1;
  }
  return order;
}

}  // namespace

template <class Scalar>
std::size_t ElementGroup<Scalar>::bytes_per_element() const {
  const std::size_t vectors =
      kernels->reads_positions ? static_cast<std::size_t>(num_nodes * dim) : 0;
  const std::size_t stored_state = state.empty() ? 0 : static_cast<std::size_t>(kernels->num_state);
  return static_cast<std::size_t>(num_nodes) * sizeof(std::int32_t) +
         (vectors + static_cast<std::size_t>(kernels->num_constants) + stored_state) *
             sizeof(Scalar);
}

template <class Scalar>
KernelArguments<Scalar> ElementGroup<Scalar>::arguments(std::size_t batch) const {
  const std::size_t l = static_cast<std::size_t>(lanes);
  KernelArguments<Scalar> result;
  if (!positions.empty()) result.positions = positions.data() + batch * values_per_batch();
  result.parameters = parameters.data();
  result.constants =
      constants.data() + batch * static_cast<std::size_t>(kernels->num_constants) * l;
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
  group.table = source.table;
  group.kernels = source.kernels;
  group.dim = mesh.dim;
  group.num_nodes = source.table->num_nodes;
  group.lanes = source.table->lanes;
  group.density = source.density;
  for (const double p : source.parameters) group.parameters.push_back(static_cast<Scalar>(p));
  group.num_elements = source.elements.size();

  const std::size_t lanes = static_cast<std::size_t>(group.lanes);
  const std::size_t nodes = static_cast<std::size_t>(group.num_nodes);
  const std::size_t dim = static_cast<std::size_t>(group.dim);
  const std::vector<std::size_t> order = batch_order(group.num_elements, lanes);
  group.num_batches = order.size() / lanes;
  group.elements.resize(order.size());
  group.dofs.resize(order.size() * nodes);
  group.positions.resize(order.size() * nodes * dim);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t batch = k / lanes;
    const std::size_t lane = k % lanes;
    const std::size_t e = static_cast<std::size_t>(source.elements[order[k]]);
    group.elements[k] = static_cast<std::int32_t>(source.first_element + e);
    const std::span<const std::int32_t> element_nodes = block.element_nodes(e);
    for (std::size_t a = 0; a < nodes; ++a) {
      const std::size_t own =
          source.node_order.empty()
              ? a
              : static_cast<std::size_t>(source.node_order[order[k] * nodes + a]);
      const std::int32_t dof = element_nodes[own] * group.dim;
      group.dofs[(batch * nodes + a) * lanes + lane] = dof;
      const auto first = static_cast<std::size_t>(group.dofs[batch * nodes * lanes + lane]);
      for (std::size_t i = 0; i < dim; ++i) {
        group.positions[((batch * nodes + a) * dim + i) * lanes + lane] = static_cast<Scalar>(
            mesh.positions[static_cast<std::size_t>(dof) + i] - mesh.positions[first + i]);
      }
    }
  }
  return group;
}

template <class Scalar>
void compute_constants(ElementGroup<Scalar>& group, int threads) {
  const std::size_t per_batch = static_cast<std::size_t>(group.kernels->num_constants) *
                                static_cast<std::size_t>(group.lanes);
  group.constants.resize(group.num_batches * per_batch);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t batch = 0; batch < group.num_batches; ++batch) {
    KernelArguments<Scalar> arguments = group.arguments(batch);
    arguments.output = group.constants.data() + batch * per_batch;
    group.kernels->constants(arguments);
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
