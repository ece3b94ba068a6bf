// What generated OpenCL kernels are written with: numbers, functions, and the steps between the
// arrays of a mesh and those of one element. OpenCL C 1.2.
//
// Numbers are float, or double where the program is built with -D ELASTOGEN_DOUBLE (the device
// needs cl_khr_fp64). -cl-fast-relaxed-math and -cl-finite-math-only would remove the test for
// results that are not finite, and must not be used.
//
// Levels of data (n = nodes of the element, d = space dimensions, a = node of the element,
// i = component, e = element of the call; stride >= num_elements, so that rows may be aligned).
// Neighbouring work items read neighbouring addresses:
//
//   element   nodes[a * stride + e]        number of the node in the mesh
//             slots[a * stride + e]        rank of the element among those of that node
//             constants[k * stride + e]    grouped constants, k < num_constants
//             state[k * stride + e]        stored by linearize, k < num_state
//             status[e]                    bits below are or-ed in
//   node      positions, displacement, direction [node * d + i]
//             partial[(slot * d + i) * node_stride + node]    written by elements, summed by nodes
//   uniform   parameters[k]                in the law's order
//
// All element kernels have the same arguments, in the same order; those that an operation does not
// use may be null:
//
//   kernel     reads                                              writes output
//   constants  nodes positions parameters                         [k * stride + e], k < num_constants
//   geometry   nodes positions                                    [k * stride + e], k < n: nodal
//                                                                 volume, k < 2 n: positive share
//                                                                 of the volume for a diagonal
//                                                                 mass, then det J of each point
//   energy     nodes positions* parameters constants displacement [e]
//   forces     ... and slots                                      partial, f = -dW/dU
//   product    ... slots and direction                            partial, p = (df/dU) V
//   linearize  as energy                                          [k * stride + e], k < num_state
//   apply      nodes slots positions* parameters constants        partial, p
//              direction state
//   stress     nodes positions parameters displacement            [k * stride + e], 20 numbers for
//                                                                 each point one after the other:
//                                                                 H[i * 3 + j] = dU_i/dX_j,
//                                                                 P[i * 3 + j] = dW/dH_ij, W, and
//                                                                 the rest volume it stands for
//   *: only where the source says reads_positions
//
// Outputs are overwritten, each by one element: no atomics, and the same bits in every run.
// Source: slots are IndexInfluence of X. Faure, thesis, Lyon 2014, section 4.3, tables 4.1-4.4.
#ifndef ELASTOGEN_PRELUDE
#define ELASTOGEN_PRELUDE

#ifdef ELASTOGEN_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
#define R(number) number
#else
typedef float real;
#define R(number) number##f
#endif

// Bits of the status of an element; 0 is a good result.
#define ELASTOGEN_NOT_FINITE 1      // an output is NaN or infinite
#define ELASTOGEN_OUTSIDE_DOMAIN 2  // the argument of a logarithm or root is not positive

#define ELASTOGEN_ELEMENT_ARGUMENTS                                                     \
  const uint num_elements, const uint stride, const uint node_stride,                   \
      __global const int *nodes, __global const int *slots,                             \
      __global const real *positions, __constant real *parameters,                      \
      __global const real *constants, __global const real *displacement,                \
      __global const real *direction, __global const real *state,                       \
      __global real *output, __global uint *status

// Values at the nodes of element e: local_values[a * dim + i] = values[nodes[a] * dim + i].
static void gather(const int num_nodes, const int dim, const size_t e, const size_t stride,
                   __global const int *nodes, __global const real *values, real *local_values) {
  for (int a = 0; a < num_nodes; ++a) {
    const size_t node = nodes[a * stride + e];
    for (int i = 0; i < dim; ++i) local_values[a * dim + i] = values[node * dim + i];
  }
}

// Contributions of element e into its own slots of its nodes.
static void scatter(const int num_nodes, const int dim, const size_t e, const size_t stride,
                    const size_t node_stride, __global const int *nodes, __global const int *slots,
                    const real *local_values, __global real *partial) {
  for (int a = 0; a < num_nodes; ++a) {
    const size_t node = nodes[a * stride + e], slot = slots[a * stride + e];
    for (int i = 0; i < dim; ++i) {
      partial[(slot * dim + i) * node_stride + node] = local_values[a * dim + i];
    }
  }
}

// Numbers of element e, one row for each: rows[k * stride + e].
static void store_rows(const int count, const size_t e, const size_t stride,
                       const real *local_values, __global real *rows) {
  for (int k = 0; k < count; ++k) rows[k * stride + e] = local_values[k];
}

// Or-s the status bits: the margin must be positive, and every number finite (zero times it is
// zero).
static void report_status(const real margin, const int count, const real *local_values,
                          const size_t e, __global uint *status) {
  if (!status) return;
  real residue = 0;
  for (int k = 0; k < count; ++k) residue += local_values[k] * 0;
  uint bits = 0;
  if (!(residue == 0)) bits |= ELASTOGEN_NOT_FINITE;
  if (!(margin > 0)) bits |= ELASTOGEN_OUTSIDE_DOMAIN;
  if (bits != 0) status[e] |= bits;
}

// The margin of a law's domain becomes the smaller of the two.
static void keep_smaller(real *margin, const real x) { *margin = x < *margin ? x : *margin; }

// x - log(1 + x) to a few units in the last place at every x > -1. Near 0 by the series of
// log(1 + x) = 2 artanh(z), z = x / (2 + x): x z - 2 z^3 (1/3 + z^2/5 + ...), Abramowitz & Stegun
// 4.6.33.
static real log1p_remainder(const real x) {
  if (!(fabs(x) < R(0.35))) return x - log1p(x);
  const real z = x / (2 + x);
  const real z2 = z * z;
  real series = R(1.0) / 25;
  for (int k = 23; k >= 3; k -= 2) series = series * z2 + R(1.0) / k;
  return x * z - 2 * z * z2 * series;
}

// exp(y) - 1 - y to a few units in the last place; near 0 by its Taylor series.
static real expm1_remainder(const real y) {
  if (!(fabs(y) < R(0.5))) return expm1(y) - y;
  real series = R(1.0) / 16;
  for (int k = 15; k >= 3; --k) series = (1 + y * series) / k;
  return y * y * (1 + y * series) / 2;
}

// max(0, -x), exactly; not a number stays what it is.
static real negative_part(const real x) { return x >= 0 ? 0 : -x; }

// x^(1/q), q >= 2; for x > 0.
static real root(const real x, const int q) {
  return q == 2 ? sqrt(x) : q == 3 ? cbrt(x) : pow(x, R(1.0) / q);
}

#endif
