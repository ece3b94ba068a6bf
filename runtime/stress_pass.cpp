#include "runtime/stress_pass.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/error.h"

namespace elastogen {
namespace {

/// point_orders[order][g]: which point of the element's own numbering the kernels' point g is.
using PointOrders = std::vector<std::vector<std::int32_t>>;

/// The kernels compute an element whose nodes stand in another order: their point g lies where the
/// element's own shape functions have the values of theirs, each at its node.
std::vector<std::int32_t> point_order(const ReferencePoints& points, int num_nodes,
                                      std::span<const int> node_order, const char* association) {
  constexpr double tolerance = 1e-9;  // of shape functions, which are of order 1
  const auto shape = [&](std::int32_t point, int node) {
    return points.shapes[point * num_nodes + node];
  };
  std::vector<std::int32_t> order;
  for (std::int32_t theirs = 0; theirs < points.num_points; ++theirs) {
    std::int32_t own = 0;
    for (; own < points.num_points; ++own) {
      bool same = true;
      for (int a = 0; a < num_nodes; ++a) {
        const int node = node_order[static_cast<std::size_t>(a)];
        same = same && std::abs(shape(theirs, a) - shape(own, node)) < tolerance;
      }
      if (same) break;
    }
    order.push_back(own);
  }
  for (const std::int32_t own : order) {
    if (own < points.num_points) continue;
    throw InternalError(fmt::format(
        "kernels of {}: the quadrature does not look the same from all corners", association));
  }
  return order;
}

template <class Scalar>
PointOrders point_orders(const ElementGroup<Scalar>& group) {
  PointOrders orders;
  if (group.node_orders.empty()) return orders;
  if (group.table->points.num_points != group.table->num_points) {
    throw InternalError(fmt::format("kernels of {}: they do not tell where their points are",
                                    group.table->association));
  }
  for (const std::vector<int>& nodes : group.node_orders) {
    orders.push_back(
        point_order(group.table->points, group.num_nodes, nodes, group.table->association));
  }
  return orders;
}

template <class Scalar>
void require_stress(const ElementGroup<Scalar>& group) {
  if (group.kernels->stress != nullptr) return;
  throw InternalError(
      fmt::format("kernels of {} ({}) were generated without the operation 'stress'",
                  group.table->association, group.kernels->geometry));
}

/// What one thread works with.
template <class Scalar>
struct Arrays {
  AlignedVector<Scalar> positions, displacement, output;

  void make_room(const ElementGroup<Scalar>& group) {
    positions.resize(group.values_per_batch());
    displacement.resize(group.values_per_batch());
    output.resize(static_cast<std::size_t>(group.table->num_points * stress_numbers * group.lanes));
  }
};

/// Values of the batch's nodes, less those of its elements' node 0.
template <class Scalar>
void gather(const ElementGroup<Scalar>& group, const NodeNumbering& numbering, std::size_t batch,
            const double* values, Scalar* out) {
  const int lanes = group.lanes;
  const std::int32_t* dofs =
      group.dofs.data() + batch * static_cast<std::size_t>(group.num_nodes * lanes);
  for (int l = 0; l < lanes; ++l) {
    const double* first = values + group.dim * numbering.node_of_mesh(dofs[l] / group.dim);
    for (int a = 0; a < group.num_nodes; ++a) {
      const std::int32_t node = numbering.node_of_mesh(dofs[a * lanes + l] / group.dim);
      for (int i = 0; i < group.dim; ++i) {
        out[(a * group.dim + i) * lanes + l] =
            static_cast<Scalar>(values[node * group.dim + i] - first[i]);
      }
    }
  }
}

template <class Scalar>
PointStress point_of(const Scalar* values, int lanes) {
  PointStress point;
  const auto value = [&](int k) { return static_cast<double>(values[k * lanes]); };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      point.gradient(i, j) = value(3 * i + j);
      point.first_piola(i, j) = value(9 + 3 * i + j);
    }
  }
  point.energy_density = value(18);
  point.volume = value(19);
  return point;
}

}  // namespace

std::vector<std::size_t> first_points(std::span<const std::int32_t> element_points) {
  std::vector<std::size_t> first = {0};
  first.reserve(element_points.size() + 1);
  for (const std::int32_t count : element_points) {
    first.push_back(first.back() + static_cast<std::size_t>(count));
  }
  return first;
}

template <class Scalar>
ElementStatus compute_stress(const ElementSystem<Scalar>& elements,
                             std::span<const double> positions, const double* u,
                             StressField& field) {
  for (const ElementGroup<Scalar>& group : elements.groups()) require_stress(group);
  ElementStatus first;
  for (const ElementGroup<Scalar>& group : elements.groups()) {
    const PointOrders orders = point_orders(group);
    const auto num_batches = static_cast<std::ptrdiff_t>(group.num_batches);
    const int points = group.table->num_points;
    const int lanes = group.lanes;
#pragma omp parallel num_threads(elements.num_threads())
    {
      Arrays<Scalar> arrays;
      arrays.make_room(group);
      ElementStatus bad;
#pragma omp for schedule(static)
      for (std::ptrdiff_t b = 0; b < num_batches; ++b) {
        const auto batch = static_cast<std::size_t>(b);
        gather(group, elements.numbering(), batch, positions.data(), arrays.positions.data());
        gather(group, elements.numbering(), batch, u, arrays.displacement.data());
        KernelArguments<Scalar> arguments;
        arguments.positions = arrays.positions.data();
        arguments.parameters = group.parameters.data();
        arguments.displacement = arrays.displacement.data();
        arguments.output = arrays.output.data();
        alignas(kernel_alignment) std::uint32_t flags[most_lanes<float>] = {};
        arguments.status = flags;
        group.kernels->stress(&arguments, 1);
        bad.merge(batch_status(group, batch, flags));
        for (int l = 0; l < group.used_lanes(batch); ++l) {
          const std::size_t k =
              batch * static_cast<std::size_t>(lanes) + static_cast<std::size_t>(l);
          PointStress* out =
              field.points.data() + field.first[static_cast<std::size_t>(group.elements[k])];
          const std::int32_t* order = orders.empty() ? nullptr : orders[group.turn[k]].data();
          for (int g = 0; g < points; ++g) {
            out[order ? order[g] : g] =
                point_of(arrays.output.data() + g * stress_numbers * lanes + l, lanes);
          }
        }
      }
#pragma omp critical(elastogen_stress_status)
      first.merge(bad);
    }
  }
  return first;
}

template ElementStatus compute_stress(const ElementSystem<double>&, std::span<const double>,
                                      const double*, StressField&);
template ElementStatus compute_stress(const ElementSystem<float>&, std::span<const double>,
                                      const double*, StressField&);

}  // namespace elastogen
