// The compiled kernels that the property tests link.
#pragma once

#include <string>
#include <vector>

#include "runtime/kernel_abi.h"

namespace elastogen::test {

struct TestedKernels {
  std::string association;
  const KernelTable<double>* (*double_table)();
  const KernelTable<float>* (*float_table)();
};

[[nodiscard]] const std::vector<TestedKernels>& tested_kernels();

/// @throws std::out_of_range  if the association is not linked
[[nodiscard]] const TestedKernels& kernels_of(const std::string& association);

}  // namespace elastogen::test
