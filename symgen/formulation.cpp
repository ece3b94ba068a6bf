#include "symgen/formulation.h"

#include <fmt/format.h>

#include <algorithm>

#include "symgen/build_kernels.h"

namespace elastogen::symgen {

ChosenSplit choose_split(const AssociationId& id, const ElementGraph& graph, const Element& element,
                         const Profile& profile) {
  if (id.split != "auto") return {Split::parse(id.split), "asked for"};
  const int num_terms = static_cast<int>(graph.energies.size());
  const int num_points = static_cast<int>(graph.energies[0].size());
  const auto num_fragments = [&](const Split& split) {
    return energy_parts(split, num_terms, num_points).size() *
           row_parts(split, element.num_nodes(), element.dim).size();
  };
  std::vector<Split> splits = all_splits();
  std::stable_sort(splits.begin(), splits.end(), [&](const Split& a, const Split& b) {
    return num_fragments(a) < num_fragments(b);
  });
  for (const Split& split : splits) {
    const long largest = typical_fragment_flops(graph, split);
    if (largest <= profile.fragment_flops) {
      return {split, fmt::format("coarsest split whose fragments stay below {} flops (profile {}): "
                                 "the largest has {}",
                                 profile.fragment_flops, profile.name, largest)};
    }
  }
  return {splits.back(),
          fmt::format("finest split; even its fragments exceed {} flops (profile {})",
                      profile.fragment_flops, profile.name)};
}

}  // namespace elastogen::symgen
