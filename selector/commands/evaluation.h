// One element by compiled kernels: what `evaluate` computes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/kernel_abi.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// Results of one element; indices as in symgen::Evaluation.
struct KernelEvaluation {
  double energy = 0;
  std::vector<double> forces, product, stiffness, stress;
  std::uint32_t status = status_ok;
};

/// Calls the kernels of a table (constants, energy, forces, product where there is a direction,
/// stiffness, stress) on one element. A table of several lanes gets the element in each of them.
///
/// @throws InputError     when the table has no such geometry variant; says which it has
/// @throws InternalError  when the lanes do not agree to the last bit
template <class Scalar>
[[nodiscard]] KernelEvaluation evaluate_kernels(const KernelTable<Scalar>& table,
                                                const std::string& geometry,
                                                const symgen::ElementCase& input);

/// "ok", or what the bits of a kernel's status say is wrong.
[[nodiscard]] std::string status_text(std::uint32_t status);

}  // namespace elastogen::selector
