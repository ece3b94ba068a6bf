// The instruction sets that the default kernels of this build are compiled for.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "runtime/kernel_selection.h"

namespace elastogen::test {

inline std::vector<std::string> built_sets() {
  std::vector<std::string> sets;
  std::istringstream list(INSTRUCTION_SETS);
  for (std::string set; std::getline(list, set, ',');) sets.push_back(set);
  return sets;
}

/// Whether there are functions that choose a set: not where kernels are `native` alone.
inline bool is_chosen() { return built_sets() != std::vector<std::string>{"native"}; }

inline std::vector<std::string> supported_sets() {
  std::vector<std::string> sets = built_sets();
  std::erase_if(sets, [](const std::string& set) { return !processor_supports(set); });
  return sets;
}

}  // namespace elastogen::test
