#include "symgen/passes/profile.h"

#include <fmt/format.h>

#include <limits>

#include "runtime/error.h"

namespace elastogen::symgen {

const std::vector<Profile>& profiles() {
  // beta: measured flops per streamed double on current x86 cores with 512-bit vectors; a position
  // is shared by the elements around its node and comes from cache, but has to be gathered.
  // fragment_flops: straight-line code of about 6000 operations still fits the instruction cache
  // level that feeds vector units at full rate, and compiles in seconds.
  // straight_line_flops: about 2500 instructions fit into the cache of decoded instructions of a
  // current x86 core; beyond, decoding limits the rate. A GPU's loop would index private memory.
  constexpr long never = std::numeric_limits<long>::max();
  static const std::vector<Profile> all = {
      {"x86-cache", "meshes that fit in the last-level cache", {5, 5}, 6000, 1000},
      {"x86-dram", "meshes that stream from memory", {35, 12}, 6000, 1000},
      {"gpu", "one work item per element", {20, 10}, 2000, never},
  };
  return all;
}

const Profile& find_profile(const std::string& name) {
  std::string known;
  for (const Profile& profile : profiles()) {
    if (profile.name == name) return profile;
    known += (known.empty() ? "" : ", ") + profile.name;
  }
  throw InputError(fmt::format("unknown target profile '{}': allowed are {}", name, known));
}

}  // namespace elastogen::symgen
