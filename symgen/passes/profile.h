// Target profiles: what reading costs and how large a fragment may be.
#pragma once

#include <string>
#include <vector>

#include "symgen/passes/extract_grouped_constants.h"

namespace elastogen::symgen {

/// Named, so that generation is reproducible: the profile enters the hash of what is generated.
struct Profile {
  std::string name;
  std::string description;
  CutPrices prices;
  long fragment_flops;  ///< `auto` takes the coarsest split whose fragments stay below
  /// Unsplit kernels whose product has more flops are loops over quadrature points.
  long straight_line_flops;
};

[[nodiscard]] const std::vector<Profile>& profiles();

/// @throws InputError  for an unknown name; says which exist
[[nodiscard]] const Profile& find_profile(const std::string& name);

}  // namespace elastogen::symgen
