// What an association's names stand for: law, element and quadrature as one graph per geometry
// variant, and the split.
#pragma once

#include "symgen/build_kernels.h"
#include "symgen/mechanics/element_graph.h"
#include "symgen/mechanics/energy.h"
#include "symgen/mechanics/stress_graph.h"
#include "symgen/passes/profile.h"
#include "symgen/passes/split.h"
#include "symgen/pipeline.h"

namespace elastogen::symgen {

struct Formulation {
  Formulation(const AssociationId& id, const Law& law, bool stabilise, Derivation derivation)
      : element(find_element(id.element)),
        quadrature(find_quadrature(id.element, id.quadrature)),
        energy(energy_density(law, element.dim, {stabilise})),
        stress{{stabilise}, derivation},
        derivation(derivation) {
    check_association(id, law);
  }
  [[nodiscard]] ElementGraph graph(const Law& law, Geometry geometry) const {
    return build_element_graph(law, energy, element, quadrature, geometry, derivation);
  }
  [[nodiscard]] PointwiseGraph pointwise_graph(const Law& law, Geometry geometry) const {
    return build_pointwise_graph(law, energy, element, quadrature, geometry);
  }
  [[nodiscard]] StressGraph stress_graph(const Law& law, Geometry geometry,
                                         const std::shared_ptr<NumberPool>& numbers) const {
    return build_stress_graph(law, element, quadrature, geometry, stress, numbers);
  }
  [[nodiscard]] StressGraph pointwise_stress_graph(
      const Law& law, Geometry geometry, const std::shared_ptr<NumberPool>& numbers) const {
    return build_pointwise_stress_graph(law, element, quadrature, geometry, stress, numbers);
  }
  const Element& element;
  const Quadrature& quadrature;
  EnergyDensity energy;
  StressOptions stress;
  Derivation derivation;
};

struct ChosenSplit {
  Split split;
  std::string reason;
};

/// The split of an association; for `auto` none where unsplit kernels may be loops over points,
/// else the coarsest whose fragments stay below the profile's limit (fewest fragments first).
[[nodiscard]] ChosenSplit choose_split(const AssociationId& id, const Formulation& formulation,
                                       const Law& law, const Profile& profile);

/// The kernels of one geometry variant, as loops over quadrature points where they are unsplit and
/// too long for straight-line code. GiNaC's derivatives are of whole elements: never loops.
[[nodiscard]] VariantKernels kernels_of(const Formulation& formulation, const Law& law,
                                        Geometry geometry, const Split& split,
                                        const Profile& profile, Grouping grouping, StageLog& log);

}  // namespace elastogen::symgen
