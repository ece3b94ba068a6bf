#include "symgen/formulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "symgen/build_kernels.h"
#include "symgen/build_stress.h"

namespace elastogen::symgen {

namespace {

bool may_be_loops(const Formulation& formulation, const Profile& profile) {
  return formulation.derivation == Derivation::dag && formulation.quadrature.num_points() > 1 &&
         profile.straight_line_flops < std::numeric_limits<long>::max();
}

}  // namespace

ChosenSplit choose_split(const AssociationId& id, const Formulation& formulation, const Law& law,
                         const Profile& profile) {
  if (id.split != "auto") return {Split::parse(id.split), "asked for"};
  if (may_be_loops(formulation, profile)) {
    return {Split{}, fmt::format("unsplit: what has more than {} flops is a loop over quadrature "
                                 "points (profile {})",
                                 profile.straight_line_flops, profile.name)};
  }
  const Element& element = formulation.element;
  const ElementGraph graph = formulation.graph(law, Geometry::general);
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

VariantKernels kernels_of(const Formulation& formulation, const Law& law, Geometry geometry,
                          const Split& split, const Profile& profile, Grouping grouping,
                          StageLog& log) {
  if (split.text() == "none" && may_be_loops(formulation, profile)) {
    StageLog of_loops = log;
    PointwiseGraph graph = formulation.pointwise_graph(law, geometry);
    of_loops.end("pointwise_graph", graph.point.dag.size() + graph.whole.dag.size());
    VariantKernels kernels =
        build_point_kernels(std::move(graph), geometry, profile, grouping, of_loops);
    if (kernels.flops("product") > profile.straight_line_flops) {
      add_stress(kernels,
                 formulation.pointwise_stress_graph(law, geometry, kernels.dag.number_pool()),
                 split, of_loops);
      log = std::move(of_loops);
      return kernels;
    }
    log.end("loops over points (not taken)", kernels.dag.size());
  }
  ElementGraph graph = formulation.graph(law, geometry);
  log.end("element_graph", graph.dag.size());
  VariantKernels kernels = build_kernels(std::move(graph), geometry, split, profile, grouping, log);
  add_stress(kernels, formulation.stress_graph(law, geometry, kernels.dag.number_pool()), split,
             log);
  return kernels;
}

}  // namespace elastogen::symgen
