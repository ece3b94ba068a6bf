// Which build of its kernels a library takes: the best that the processor has, chosen once, or the
// one that the environment variable ELASTOGEN_INSTRUCTION_SET names.
//
// Included by the sources with which CMake ends a library of kernels (ElastogenKernels.cmake).
// Those are compiled without options for an instruction set: they run before the choice.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

#include "runtime/error.h"
#include "runtime/kernel_abi.h"

namespace elastogen {

inline constexpr const char* instruction_set_variable = "ELASTOGEN_INSTRUCTION_SET";

/// The kernels of one association, compiled for one instruction set.
template <class Scalar>
struct KernelBuild {
  const char* instruction_set;
  const KernelTable<Scalar>* (*table)();  ///< not to be called where the set is not supported
};

/// Whether this processor and its operating system have what "avx2" and "avx512" are compiled for,
/// x86-64-v3 and x86-64-v4 of the x86-64 psABI; "x86_64" is its baseline. Whoever compiled "native"
/// for some processor has to know where it runs.
inline bool processor_supports(std::string_view instruction_set) {
  if (instruction_set == "native") return true;
#if defined(__x86_64__)
  if (instruction_set == "x86_64") return true;
  __builtin_cpu_init();
  unsigned int a = 0, b = 0, basic = 0, extended = 0, d = 0;
  __get_cpuid(1, &a, &b, &basic, &d);
  __get_cpuid(0x80000001, &a, &b, &extended, &d);
  // What clang 14 cannot ask for by name.
  constexpr unsigned int movbe = 1U << 22U, f16c = 1U << 29U, lzcnt = 1U << 5U;
  const bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                      (basic & movbe) != 0 && (basic & f16c) != 0 && (extended & lzcnt) != 0;
  if (instruction_set == "avx2") return has_v3;
  if (instruction_set == "avx512") {
    return has_v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
  }
#endif
  return false;
}

/// The last supported set of `built`, or `wanted` unless that is empty.
///
/// @param association   whose kernels they are, for errors
/// @param built         at least one, the best one last
/// @param wanted        value of the environment variable
/// @param is_supported  function of a set's name
/// @throws InputError   `wanted` is unknown, not built or not supported; none is supported
template <class IsSupported>
std::string choose_instruction_set(const std::string& association,
                                   const std::vector<std::string>& built, const std::string& wanted,
                                   const IsSupported& is_supported) {
  std::string best, usable, all;
  for (const std::string& set : built) {
    all += (all.empty() ? "" : ", ") + set;
    if (!is_supported(set)) continue;
    usable += (usable.empty() ? "" : ", ") + set;
    best = set;
  }
  if (best.empty()) {
    throw InputError("kernels of " + association + " are compiled for " + all +
                     ", which this processor or its operating system does not have; compile them "
                     "for x86_64, too (CMake: ELASTOGEN_KERNEL_INSTRUCTION_SETS)");
  }
  if (wanted.empty()) return best;
  const auto is_wanted = [&wanted](const std::string& set) { return set == wanted; };
  const bool is_built = std::any_of(built.begin(), built.end(), is_wanted);
  if (is_built && is_supported(wanted)) return wanted;
  const std::vector<std::string> known = {"x86_64", "avx2", "avx512", "native"};
  const char* reason = "no such instruction set is known";
  if (is_built) {
    reason = "this processor or its operating system does not have it";
  } else if (std::any_of(known.begin(), known.end(), is_wanted)) {
    reason = "they are not compiled for it (CMake: ELASTOGEN_KERNEL_INSTRUCTION_SETS)";
  }
  throw InputError(std::string(instruction_set_variable) + " = '" + wanted +
                   "' in the environment: kernels of " + association + ": " + reason +
                   "; here it may be " + usable + ", or unset for the best of these");
}

/// The table of the build that this processor is to run.
/// @throws InputError  as choose_instruction_set
template <class Scalar>
const KernelTable<Scalar>* choose_table(const std::string& association,
                                        const std::vector<KernelBuild<Scalar>>& builds) {
  std::vector<std::string> built;
  for (const KernelBuild<Scalar>& build : builds) built.emplace_back(build.instruction_set);
  const char* const wanted = std::getenv(instruction_set_variable);
  const std::string chosen = choose_instruction_set(
      association, built, wanted != nullptr ? wanted : "", processor_supports);
  const auto build = std::find(built.begin(), built.end(), chosen);
  return builds[static_cast<std::size_t>(build - built.begin())].table();
}

}  // namespace elastogen
