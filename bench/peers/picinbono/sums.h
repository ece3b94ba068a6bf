// Forces and products of one tetrahedron, or of several as lanes, as sums over its tensors. Terms
// of the same pair of vertices are gathered before they are multiplied by a displacement: that is
// less work than one term after the other, with the same constants.
//
//   force on p = sum_k B^pk U_k  +  sum_kl (U_k . U_l) C^pkl  +  sum_k s_pk U_k
//   s_pk = 2 sum_j C^jpk . U_j  +  4 sum_lm D^pklm (U_l . U_m)
//
// (X. Faure's thesis, eq. 2.16, has 2 B^pk: that fits an energy of U_j B^jk U_k without the half.)
// Loops are unrolled so that the compiler knows where each tensor lies.
#pragma once

#include "tensors.h"

namespace elastogen::peers {

/// A vector of each vertex.
template <class Number>
using VertexVectors = Number[4][3];
/// A number of each pair, the same in either order.
template <class Number>
using PairNumbers = Number[num_pairs];

template <class Number>
Number dot(const Number (&a)[3], const Number (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// U_k . U_l
template <class Number>
void pair_products(const VertexVectors<Number>& u, PairNumbers<Number>& products) {
#pragma GCC unroll 10
  for (int pair = 0; pair < num_pairs; ++pair) {
    products[pair] = dot(u[pairs[pair].first], u[pairs[pair].second]);
  }
}

/// Their derivative in a direction.
template <class Number>
void pair_products(const VertexVectors<Number>& u, const VertexVectors<Number>& v,
                   PairNumbers<Number>& products) {
#pragma GCC unroll 10
  for (int pair = 0; pair < num_pairs; ++pair) {
    const auto [k, l] = pairs[pair];
    products[pair] = dot(u[k], v[l]) + dot(v[k], u[l]);
  }
}

/// sum_lm D^pklm products_lm
template <class Number>
Number quartic_sum(const StvkTensors<Number>& tensors, int p, int k,
                   const PairNumbers<Number>& products) {
  Number sum{};
#pragma GCC unroll 10
  for (int pair = 0; pair < num_pairs; ++pair) {
    const auto [l, m] = pairs[pair];
    Number d = tensors.d[quartic_places.place[p][k][l][m]];
    if (l != m) d += tensors.d[quartic_places.place[p][k][m][l]];
    sum += d * products[pair];
  }
  return sum;
}

/// s_pk; linear in both arguments together, so that derivatives come out of derivatives.
template <class Number>
void pair_factors(const StvkTensors<Number>& tensors, const VertexVectors<Number>& u,
                  const PairNumbers<Number>& products, PairNumbers<Number>& factors) {
#pragma GCC unroll 10
  for (int pair = 0; pair < num_pairs; ++pair) {
    Number cubic{};
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) cubic += dot(tensors.c[pair][j], u[j]);
    const auto [p, k] = pairs[pair];
    factors[pair] = 2 * cubic + 4 * quartic_sum(tensors, p, k, products);
  }
}

/// result_p += sum_k B^pk U_k
template <class Number>
void add_linear_terms(const HookeTensors<Number>& tensors, const VertexVectors<Number>& u,
                      VertexVectors<Number>& result) {
#pragma GCC unroll 10
  for (int pair = 0; pair < num_pairs; ++pair) {
    const auto [p, k] = pairs[pair];
    const auto& b = tensors.b[pair];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      result[p][i] += dot(b[i], u[k]);
      if (p != k) result[k][i] += b[0][i] * u[p][0] + b[1][i] * u[p][1] + b[2][i] * u[p][2];
    }
  }
}

/// result_p += sum_kl products_kl C^pkl
template <class Number>
void add_quadratic_terms(const StvkTensors<Number>& tensors, const PairNumbers<Number>& products,
                         VertexVectors<Number>& result) {
#pragma GCC unroll 10
  for (int pair = 0; pair < num_pairs; ++pair) {
    const bool is_edge = pairs[pair].first != pairs[pair].second;
    const Number product = is_edge ? 2 * products[pair] : products[pair];
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      for (int i = 0; i < 3; ++i) result[p][i] += product * tensors.c[pair][p][i];
    }
  }
}

/// result_p += sum_k factors_pk U_k
template <class Number>
void add_pair_terms(const PairNumbers<Number>& factors, const VertexVectors<Number>& u,
                    VertexVectors<Number>& result) {
#pragma GCC unroll 4
  for (int p = 0; p < 4; ++p) {
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 3; ++i) result[p][i] += factors[pair_of[p][k]] * u[k][i];
    }
  }
}

template <class Number>
void add_forces(const HookeTensors<Number>& tensors, const VertexVectors<Number>& u,
                VertexVectors<Number>& result) {
  add_linear_terms(tensors, u, result);
}

template <class Number>
void add_forces(const StvkTensors<Number>& tensors, const VertexVectors<Number>& u,
                VertexVectors<Number>& result) {
  PairNumbers<Number> products, factors;
  pair_products(u, products);
  pair_factors(tensors, u, products, factors);
  add_linear_terms(tensors.linear, u, result);
  add_quadratic_terms(tensors, products, result);
  add_pair_terms(factors, u, result);
}

/// The derivative of the forces in the direction v.
template <class Number>
void add_product(const StvkTensors<Number>& tensors, const VertexVectors<Number>& u,
                 const VertexVectors<Number>& v, VertexVectors<Number>& result) {
  PairNumbers<Number> products, factors, product_changes, factor_changes;
  pair_products(u, products);
  pair_factors(tensors, u, products, factors);
  pair_products(u, v, product_changes);
  pair_factors(tensors, v, product_changes, factor_changes);
  add_linear_terms(tensors.linear, v, result);
  add_quadratic_terms(tensors, product_changes, result);
  add_pair_terms(factor_changes, u, result);
  add_pair_terms(factors, v, result);
}

}  // namespace elastogen::peers
