// What an association's names stand for: law, element and quadrature as one graph per geometry
// variant, and the split.
#pragma once

#include "symgen/mechanics/element_graph.h"
#include "symgen/mechanics/energy.h"
#include "symgen/passes/profile.h"
#include "symgen/passes/split.h"
#include "symgen/pipeline.h"

namespace elastogen::symgen {

struct Formulation {
  Formulation(const AssociationId& id, const Law& law, bool stabilise, Derivation derivation)
      : element(find_element(id.element)),
        quadrature(find_quadrature(id.element, id.quadrature)),
        energy(energy_density(law, element.dim, {stabilise})),
        derivation(derivation) {
    check_association(id, law);
  }
  [[nodiscard]] ElementGraph graph(const Law& law, Geometry geometry) const {
    return build_element_graph(law, energy, element, quadrature, geometry, derivation);
  }
  const Element& element;
  const Quadrature& quadrature;
  EnergyDensity energy;
  Derivation derivation;
};

struct ChosenSplit {
  Split split;
  std::string reason;
};

/// The split of an association; for `auto`, the coarsest whose fragments stay below the profile's
/// limit (fewest fragments first).
[[nodiscard]] ChosenSplit choose_split(const AssociationId& id, const ElementGraph& graph,
                                       const Element& element, const Profile& profile);

}  // namespace elastogen::symgen
