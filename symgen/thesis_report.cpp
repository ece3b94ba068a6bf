#include "symgen/thesis_report.h"

#include <span>

#include "symgen/mechanics/expanded_formulation.h"

namespace elastogen::symgen {
namespace {

/// A column of tables 3.4 to 3.7, for the rule with so many points.
struct PrintedColumn {
  std::string law, element;
  int num_points;
  ThesisNumbers numbers;
};

const std::vector<PrintedColumn>& printed_columns() {
  static const std::vector<PrintedColumn> columns = {
      {"hooke", "tri3", 1, {"general", 6, {5, 7}}},
      {"stvk", "tri3", 1, {"general", 6, {5, 5}}},
      {"hooke", "tet4", 1, {"general", 11, {10, 16}}},
      {"stvk", "tet4", 1, {"general", 11, {10, 10}}},
      {"hooke", "pyramid5", 5, {"general", 71, {17, 23, 15, 21, 17, 23, 15, 21, 12, 18}}},
      {"stvk", "pyramid5", 5, {"general", 71, {17, 17, 15, 15, 17, 17, 15, 15, 12, 12}}},
      {"hooke", "prism6", 6, {"general", 77, {16, 22, 16, 22, 16, 22, 16, 22, 16, 22, 16, 22}}},
      {"stvk", "prism6", 6, {"general", 77, {16, 16, 16, 16, 16, 16, 16, 16, 16, 16, 16, 16}}},
      {"hooke", "hexa8", 8, {"box", 40, {8, 13, 13, 12, 12, 13, 13, 8}}},
      {"stvk", "hexa8", 8, {"box", 40, {8, 13, 13, 12, 12, 13, 13, 8}}}};
  return columns;
}

int num_constants(const Dag& dag, std::span<const NodeId> energies) {
  return static_cast<int>(energy_constants(dag, energies).constants.size());
}

ThesisVariant variant_of(const Law& law, const ElementGraph& graph, Geometry geometry) {
  ThesisVariant variant;
  variant.geometry = geometry_name(geometry);
  std::vector<NodeId> all;
  for (std::size_t l = 0; l < graph.energies.size(); ++l) {
    for (std::size_t g = 0; g < graph.energies[l].size(); ++g) {
      const NodeId energy = graph.energies[l][g];
      all.push_back(energy);
      variant.fragments.push_back({law.terms[l].name, static_cast<int>(g),
                                   num_constants(graph.dag, std::span(&energy, 1))});
    }
  }
  variant.constants = num_constants(graph.dag, all);
  return variant;
}

}  // namespace

ThesisReport thesis_report(const AssociationId& id, const Law& law) {
  check_association(id, law);
  const Element& element = find_element(id.element);
  const Quadrature& quadrature = find_quadrature(id.element, id.quadrature);
  const EnergyDensity energy = energy_density(law, element.dim, {.stabilise = false});
  ThesisReport report;
  for (const Geometry geometry : geometries_of(element)) {
    const ElementGraph graph = build_element_graph(law, energy, element, quadrature, geometry);
    report.variants.push_back(variant_of(law, graph, geometry));
    if (geometry != Geometry::general || !element.affine || !law.polynomial) continue;
    const ExpandedFormulation expanded = expand_formulation(graph);
    report.expanded = {expanded.monomials, flops_of(expanded, std::span(&expanded.energy, 1)),
                       flops_of(expanded, expanded.forces), flops_of(expanded, expanded.product)};
  }
  for (const PrintedColumn& column : printed_columns()) {
    const bool is_ours = column.law == law.name && column.element == element.name &&
                         column.num_points == quadrature.num_points();
    if (is_ours) report.printed = column.numbers;
  }
  return report;
}

}  // namespace elastogen::symgen
