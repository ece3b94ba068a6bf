// Kernels written by hand, of one batch at a time.
#pragma once

#include "runtime/kernel_abi.h"

namespace elastogen::test {

/// The kernel function of what computes one batch.
template <auto compute_one>
void each_batch(const KernelArguments<double>* batches, int count) {
  for (int k = 0; k < count; ++k) compute_one(batches[k]);
}

}  // namespace elastogen::test
