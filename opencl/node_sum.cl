// The second half of forces and products: every node adds up what its elements left in its slots.
#include "opencl/prelude.cl"

// One work item per node:
//   result[node * dim + i] += scale * sum over slot < num_slots[node] of
//                             partial[(slot * dim + i) * node_stride + node]
// Slots are added in their order, so equal input gives equal bits in every run. Slots that the node
// does not have are not read.
// Source: X. Faure, thesis, Lyon 2014, code 7, table 4.5.
__kernel void elastogen_node_sum(const uint num_nodes, const uint node_stride, const uint dim,
                                 const real scale, __global const int *num_slots,
                                 __global const real *partial, __global real *result) {
  const size_t node = get_global_id(0);
  if (node >= num_nodes) return;
  for (size_t i = 0; i < dim; ++i) {
    real sum = 0;
    for (size_t slot = 0; slot < (size_t)num_slots[node]; ++slot) {
      sum += partial[(slot * dim + i) * node_stride + node];
    }
    result[node * dim + i] += scale * sum;
  }
}
