// The compiled kernels that the property tests link.
#pragma once

#include <string>
#include <vector>

#include "runtime/kernel_abi.h"

namespace elastogen::test {

struct TestedKernels {
  std::string association;
  const KernelTable<double>* (*double_table)();
  const KernelTable<float>* (*float_table)();  ///< null: not compiled in float
};

[[nodiscard]] const std::vector<TestedKernels>& tested_kernels();

[[nodiscard]] bool is_tested(const std::string& association);

/// @throws std::out_of_range  if the association is not linked
[[nodiscard]] const TestedKernels& kernels_of(const std::string& association);

}  // namespace elastogen::test
