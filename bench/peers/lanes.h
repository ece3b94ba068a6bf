// Elements as lanes of vectors: one number of several elements at once, in a vector as wide as the
// machine's. Everything is written for both, `double` being one lane.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/peers/peer_driver.h"

namespace elastogen::peers {

// Never wider: gcc would keep the vectors in memory.
#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32;
#else
inline constexpr int vector_bytes = 16;
#endif

using Lanes [[gnu::vector_size(vector_bytes)]] = double;

template <class Number>
inline constexpr int num_lanes = sizeof(Number) / sizeof(double);

// Functions of all lanes, by the names that C has for them.

inline Lanes fabs(Lanes x) { return x < 0.0 ? -x : x; }

// libmvec, the vector functions of glibc, by the names that gcc calls them by itself.
#if defined(__AVX512F__) && defined(__GLIBC__)
extern "C" Lanes _ZGVeN8v_log(Lanes);
inline Lanes log(Lanes x) { return _ZGVeN8v_log(x); }
#elif defined(__AVX2__) && defined(__GLIBC__)
extern "C" Lanes _ZGVdN4v_log(Lanes);
inline Lanes log(Lanes x) { return _ZGVdN4v_log(x); }
#else
inline Lanes log(Lanes x) {
  for (int lane = 0; lane < num_lanes<Lanes>; ++lane) x[lane] = std::log(x[lane]);
  return x;
}
#endif

/// Fills the last batch with copies of the last element, on nodes of their own behind the others:
/// loops over batches need no special case, and results of nodes that count are not touched.
inline void fill_last_batch(Problem& problem, std::size_t nodes_per_element, std::size_t lanes) {
  const std::vector<std::int32_t> last(problem.connectivity.end() - nodes_per_element,
                                       problem.connectivity.end());
  while (problem.connectivity.size() / nodes_per_element % lanes != 0) {
    for (const std::int32_t node : last) {
      problem.connectivity.push_back(static_cast<std::int32_t>(problem.positions.size() / 3));
      for (auto* vector : {&problem.positions, &problem.displacement, &problem.direction}) {
        for (int i = 0; i < 3; ++i) vector->push_back((*vector)[3 * node + i]);
      }
    }
  }
}

/// Where the nodes of batches of consecutive elements begin in vectors of 3 numbers per node:
/// [batch][node][lane].
/// @param order  of the nodes, as places in the problem's order
template <int num_nodes>
[[nodiscard]] std::vector<std::int32_t> batch_nodes(const Problem& problem, int lanes,
                                                    const int (&order)[num_nodes]) {
  std::vector<std::int32_t> begins;
  begins.reserve(problem.connectivity.size());
  const std::size_t per_batch = static_cast<std::size_t>(lanes) * num_nodes;
  for (std::size_t batch = 0; batch < problem.connectivity.size(); batch += per_batch) {
    for (const int node : order) {
      for (int lane = 0; lane < lanes; ++lane) {
        begins.push_back(3 * problem.connectivity[batch + lane * num_nodes + node]);
      }
    }
  }
  return begins;
}

/// values[3 * node + i] of each lane, from a vector of 3 numbers per node.
/// @param nodes  of one batch, as batch_nodes() orders them
template <int num_nodes, class Number>
void gather(const double* vector, const std::int32_t* nodes, Number* values) {
  constexpr int lanes = num_lanes<Number>;
  for (int node = 0; node < num_nodes; ++node) {
    for (int i = 0; i < 3; ++i) {
      if constexpr (lanes == 1) {
        values[3 * node + i] = vector[nodes[node] + i];
      } else {
        Number value{};
        for (int lane = 0; lane < lanes; ++lane) {
          value[lane] = vector[nodes[node * lanes + lane] + i];
        }
        values[3 * node + i] = value;
      }
    }
  }
}

/// Adds scale * values, one element after the other: lanes may share nodes.
template <int num_nodes, class Number>
void scatter_add(double scale, const Number* values, const std::int32_t* nodes, double* vector) {
  constexpr int lanes = num_lanes<Number>;
  const auto* numbers = reinterpret_cast<const double*>(values);
  for (int lane = 0; lane < lanes; ++lane) {
    for (int node = 0; node < num_nodes; ++node) {
      double* sum = vector + nodes[node * lanes + lane];
      for (int i = 0; i < 3; ++i) sum[i] += scale * numbers[(3 * node + i) * lanes + lane];
    }
  }
}

}  // namespace elastogen::peers
