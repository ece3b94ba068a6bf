// A kernel's way between global vectors and the packs of a batch: gather, compute, add. Compiled
// with the kernels, for their instruction set; the runtime itself uses gather_numbers alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#ifdef __AVX__
#include <immintrin.h>
#endif

#include "runtime/kernel_abi.h"
#include "runtime/kernel_functions.h"
#include "runtime/kernel_instruction_set.h"

namespace elastogen::kernel {
inline namespace ELASTOGEN_INSTRUCTION_SET {

/// Four doubles: a node, and nothing behind it.
using Quad = Pack<double, 4>;
/// x, y, z of several nodes, one per lane.
template <int lanes>
struct Triple {
  Pack<double, lanes> x, y, z;
};

/// The three doubles of a node and a zero; reads no more than these.
inline Quad load_quad(const double* node) {
#ifdef __AVX__
  return _mm256_maskload_pd(node, _mm256_set_epi64x(0, -1, -1, -1));
#else
  return Quad{node[0], node[1], node[2], 0};
#endif
}

/// Loads nodes of 3 doubles.
/// @param dofs  of the nodes
template <int lanes>
Triple<lanes> load_nodes(const std::int32_t* dofs, const double* u);

/// x and y of the even lanes in turn, and of the odd ones.
template <class V>
struct Interleaved {
  V even, odd;
};
inline Interleaved<Quad> interleaved(const Quad& x, const Quad& y) {
  return {__builtin_shufflevector(x, y, 0, 4, 2, 6), __builtin_shufflevector(x, y, 1, 5, 3, 7)};
}
inline Interleaved<Pack<double, 8>> interleaved(const Pack<double, 8>& x,
                                                const Pack<double, 8>& y) {
  return {__builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
          __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15)};
}

template <>
inline Triple<4> load_nodes<4>(const std::int32_t* dofs, const double* u) {
  const Quad a = load_quad(u + dofs[0]), b = load_quad(u + dofs[1]);
  const Quad c = load_quad(u + dofs[2]), d = load_quad(u + dofs[3]);
  const auto [ab_xz, ab_y] = interleaved(a, b);  // x x z z, y y 0 0
  const auto [cd_xz, cd_y] = interleaved(c, d);
  return {__builtin_shufflevector(ab_xz, cd_xz, 0, 1, 4, 5),
          __builtin_shufflevector(ab_y, cd_y, 0, 1, 4, 5),
          __builtin_shufflevector(ab_xz, cd_xz, 2, 3, 6, 7)};
}

template <>
inline Triple<8> load_nodes<8>(const std::int32_t* dofs, const double* u) {
  Pack<double, 8> pair[4];  // of lanes k and k + 4
  for (int k = 0; k < 4; ++k) {
    pair[k] = __builtin_shufflevector(load_quad(u + dofs[k]), load_quad(u + dofs[k + 4]), 0, 1, 2,
                                      3, 4, 5, 6, 7);
  }
  const auto [xz01, y01] = interleaved(pair[0], pair[1]);
  const auto [xz23, y23] = interleaved(pair[2], pair[3]);
  return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

/// sum[dof + i] += scale * value of each lane, one lane after the other: lanes may share nodes.
/// Written as x and y together and z: a store that reached into the next node would make that one's
/// load wait.
template <int lanes>
inline void add_to_nodes(const std::int32_t* dofs, const Triple<lanes>& value, double scale,
                         double* sum) {
  // No structured binding: clang 14 does not capture these.
  const auto pairs = interleaved(value.x, value.y);
  const auto add_lane = [&](auto lane) {
    constexpr int l = lane, pair = l / 2 * 2;
    const auto& of_two = l % 2 == 0 ? pairs.even : pairs.odd;
    double* const node = sum + dofs[l];
    Pack<double, 2> xy;
    std::memcpy(&xy, node, sizeof xy);
    xy += scale * __builtin_shufflevector(of_two, of_two, pair, pair + 1);
    std::memcpy(node, &xy, sizeof xy);
    node[2] += scale * value.z[l];
  };
  [&]<int... lane>(std::integer_sequence<int, lane...>) {
    (add_lane(std::integral_constant<int, lane>{}), ...);
  }
  (std::make_integer_sequence<int, lanes>{});
}

/// Doubles as floats and back.
inline Pack<float, 8> to_floats(const Pack<double, 4>& low, const Pack<double, 4>& high) {
  return __builtin_shufflevector(__builtin_convertvector(low, Pack<float, 4>),
                                 __builtin_convertvector(high, Pack<float, 4>), 0, 1, 2, 3, 4, 5, 6,
                                 7);
}
inline Pack<float, 16> to_floats(const Pack<double, 8>& low, const Pack<double, 8>& high) {
  return __builtin_shufflevector(__builtin_convertvector(low, Pack<float, 8>),
                                 __builtin_convertvector(high, Pack<float, 8>), 0, 1, 2, 3, 4, 5, 6,
                                 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
inline Pack<double, 4> low_doubles(const Pack<float, 8>& v) {
  return __builtin_convertvector(__builtin_shufflevector(v, v, 0, 1, 2, 3), Quad);
}
inline Pack<double, 4> high_doubles(const Pack<float, 8>& v) {
  return __builtin_convertvector(__builtin_shufflevector(v, v, 4, 5, 6, 7), Quad);
}
inline Pack<double, 8> low_doubles(const Pack<float, 16>& v) {
  const auto half = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
  return __builtin_convertvector(half, Pack<double, 8>);
}
inline Pack<double, 8> high_doubles(const Pack<float, 16>& v) {
  const auto half = __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
  return __builtin_convertvector(half, Pack<double, 8>);
}

/// out[(a * dim + i) * lanes + l] = u[dofs[a * lanes + l] + i], in single precision less that of
/// node 0, number by number.
template <class S, int dim, int lanes>
inline void gather_numbers(const std::int32_t* dofs, int num_nodes, const double* u, S* out) {
  for (int a = 0; a < num_nodes; ++a) {
    for (int l = 0; l < lanes; ++l) {
      for (int i = 0; i < dim; ++i) {
        double value = u[dofs[a * lanes + l] + i];
        if constexpr (std::is_same_v<S, float>) value -= u[dofs[l] + i];
        out[(a * dim + i) * lanes + l] = static_cast<S>(value);
      }
    }
  }
}

/// The same by vectors.
template <int num_nodes, class V>
inline void gather_packs(const std::int32_t* dofs, const double* u, V* out) {
  constexpr int lanes = lanes_of<V>;
  if constexpr (std::is_same_v<Scalar<V>, double>) {
    for (int a = 0; a < num_nodes; ++a) {
      const Triple<lanes> node = load_nodes<lanes>(dofs + lanes * a, u);
      out[3 * a] = node.x;
      out[3 * a + 1] = node.y;
      out[3 * a + 2] = node.z;
    }
  } else {
    constexpr int half = lanes / 2;
    const Triple<half> low0 = load_nodes<half>(dofs, u), high0 = load_nodes<half>(dofs + half, u);
    for (int i = 0; i < 3; ++i) out[i] = V{};
    for (int a = 1; a < num_nodes; ++a) {
      const Triple<half> low = load_nodes<half>(dofs + lanes * a, u);
      const Triple<half> high = load_nodes<half>(dofs + lanes * a + half, u);
      out[3 * a] = to_floats(low.x - low0.x, high.x - high0.x);
      out[3 * a + 1] = to_floats(low.y - low0.y, high.y - high0.y);
      out[3 * a + 2] = to_floats(low.z - low0.z, high.z - high0.z);
    }
  }
}

/// sum[dofs[a * lanes + l] + i] += scale * value[(a * dim + i) * lanes + l], number by number.
template <class S, int dim, int lanes>
inline void add_numbers(const std::int32_t* dofs, int num_nodes, int used_lanes, const S* value,
                        double scale, double* sum) {
  for (int a = 0; a < num_nodes; ++a) {
    for (int l = 0; l < used_lanes; ++l) {
      double* const node = sum + dofs[a * lanes + l];
      for (int i = 0; i < dim; ++i) {
        node[i] += scale * static_cast<double>(value[(a * dim + i) * lanes + l]);
      }
    }
  }
}

/// The same by vectors, of all lanes.
template <int num_nodes, class V>
inline void add_packs(const std::int32_t* dofs, const V* value, double scale, double* sum) {
  constexpr int lanes = lanes_of<V>;
  for (int a = 0; a < num_nodes; ++a) {
    const V* const v = value + 3 * a;
    const std::int32_t* const node = dofs + lanes * a;
    if constexpr (std::is_same_v<Scalar<V>, double>) {
      add_to_nodes<lanes>(node, {v[0], v[1], v[2]}, scale, sum);
    } else {
      constexpr int half = lanes / 2;
      const auto add_half = [&](const std::int32_t* nodes, const auto& x, const auto& y,
                                const auto& z) {
        add_to_nodes<half>(nodes, {x, y, z}, scale, sum);
      };
      add_half(node, low_doubles(v[0]), low_doubles(v[1]), low_doubles(v[2]));
      add_half(node + half, high_doubles(v[0]), high_doubles(v[1]), high_doubles(v[2]));
    }
  }
}

/// Asks for numbers that are needed soon. A kernel reads its constants here and there, between long
/// computations and the places of its own spilled values: no processor foresees that.
template <class S>
inline void prefetch(const S* data, std::size_t count) {
  constexpr std::size_t line = 64 / sizeof(S);
  for (std::size_t k = 0; k < count; k += line) __builtin_prefetch(data + k);
}

/// NodalPassFunction of kernels with V as pack (or scalar, for one lane).
template <class V, int num_nodes, int dim>
std::uint32_t nodal_pass(const NodalPass<Scalar<V>>& pass) {
  using S = Scalar<V>;
  constexpr int lanes = lanes_of<V>;
  constexpr int num_dofs = num_nodes * dim;
  constexpr bool by_vectors = dim == 3 && lanes >= (std::is_same_v<S, double> ? 4 : 8);
  struct Packs {
    V displacement[num_dofs], direction[num_dofs], output[num_dofs];
  };
  Packs packs[most_batches_at_once];
  alignas(64) std::uint32_t flags[lanes] = {};
  KernelArguments<S> arguments[most_batches_at_once];
  double* const sum = pass.sum - pass.first_dof;
  constexpr std::size_t bytes_ahead = 4096;
  const std::size_t ahead = 1 + bytes_ahead / (sizeof(S) * (1 + pass.constants_stride));

  const auto dofs_of = [&](std::size_t batch) {
    return pass.dofs + batch * static_cast<std::size_t>(num_nodes * lanes);
  };
  const auto gather = [&](std::size_t batch, Packs& into, KernelArguments<S>& to) {
    const std::size_t set =
        pass.shape != nullptr ? static_cast<std::size_t>(pass.shape[batch]) : batch;
    const auto at = [](const S* data, std::size_t offset) {
      return data != nullptr ? data + offset : nullptr;
    };
    to.positions = at(pass.arguments.positions, set * pass.positions_stride);
    to.parameters = pass.arguments.parameters;
    to.constants = at(pass.arguments.constants, set * pass.constants_stride);
    to.state = at(pass.arguments.state, batch * pass.state_stride);
    to.displacement = reinterpret_cast<S*>(into.displacement);
    to.direction = reinterpret_cast<S*>(into.direction);
    to.output = reinterpret_cast<S*>(into.output);
    to.status = flags;
    if (pass.shape == nullptr && batch + ahead < pass.end) {
      const auto fetch = [&](const S* data, std::size_t stride) {
        if (data != nullptr) prefetch(data + (batch + ahead) * stride, stride);
      };
      fetch(pass.arguments.positions, pass.positions_stride);
      fetch(pass.arguments.constants, pass.constants_stride);
      fetch(pass.arguments.state, pass.state_stride);
    }
    const auto gather_field = [&](const double* from, V* field) {
      if (from == nullptr) return;
      if constexpr (by_vectors) {
        gather_packs<num_nodes>(dofs_of(batch), from, field);
      } else {
        gather_numbers<S, dim, lanes>(dofs_of(batch), num_nodes, from, reinterpret_cast<S*>(field));
      }
    };
    gather_field(pass.displacement, into.displacement);
    gather_field(pass.direction, into.direction);
  };
  const auto add = [&](std::size_t batch, const V* output) {
    const std::size_t left = pass.num_elements - batch * static_cast<std::size_t>(lanes);
    if constexpr (by_vectors) {
      if (left >= static_cast<std::size_t>(lanes)) {
        add_packs<num_nodes>(dofs_of(batch), output, pass.scale, sum);
        return;
      }
    }
    const int used = left < static_cast<std::size_t>(lanes) ? static_cast<int>(left) : lanes;
    add_numbers<S, dim, lanes>(dofs_of(batch), num_nodes, used, reinterpret_cast<const S*>(output),
                               pass.scale, sum);
  };

  for (std::size_t first = pass.begin; first < pass.end;) {
    const std::size_t left = pass.end - first;
    const int count = left < static_cast<std::size_t>(pass.batches_at_once) ? static_cast<int>(left)
                                                                            : pass.batches_at_once;
    for (int k = 0; k < count; ++k) {
      gather(first + static_cast<std::size_t>(k), packs[k], arguments[k]);
    }
    pass.kernel(arguments, count);
    for (int k = 0; k < count; ++k) add(first + static_cast<std::size_t>(k), packs[k].output);
    first += static_cast<std::size_t>(count);
  }
  std::uint32_t all = status_ok;
  for (const std::uint32_t flag : flags) all |= flag;
  return all;
}

}  // namespace ELASTOGEN_INSTRUCTION_SET
}  // namespace elastogen::kernel
