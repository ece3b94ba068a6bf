#include "selector/bench/choices.h"

#include <fmt/format.h>

#include <algorithm>

#include "selector/support/names.h"
#include "symgen/element/element.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {
namespace {

bool is_selected(const WorkPrecisionSelection& selection, const std::string& name) {
  return selection.elements.empty() ||
         std::any_of(selection.elements.begin(), selection.elements.end(),
                     [&](const std::string& pattern) { return matches_glob(pattern, name); });
}

/// More nodes than corners: the shape functions are of higher degree.
bool is_quadratic(const symgen::Element& element) { return element.num_nodes() > 8; }

}  // namespace

std::string WorkPrecisionChoice::resolution() const {
  return fmt::format("{}", fmt::join(cells, "x"));
}

std::vector<WorkPrecisionChoice> all_choices(const WorkPrecisionSelection& selection,
                                             const std::vector<std::string>& own_laws,
                                             const MeshFamilies& meshes,
                                             const std::vector<SolverChoice>& solvers) {
  std::vector<WorkPrecisionChoice> choices;
  const auto& laws = selection.laws.empty() ? own_laws : selection.laws;
  for (const std::string& law : laws) {
    for (const std::string& name : symgen::element_names()) {
      const symgen::Element& element = symgen::find_element(name);
      if (element.dim != 3) continue;
      for (const std::string& quadrature : symgen::quadrature_names(name)) {
        const bool analytic = symgen::find_quadrature(name, quadrature).polynomial_laws_only;
        if (analytic || !is_selected(selection, name + "-" + quadrature)) continue;
        const auto& family = is_quadratic(element) ? meshes.quadratic : meshes.linear;
        for (std::size_t s = 0; s < (selection.quick ? 1 : solvers.size()); ++s) {
          for (std::size_t m = 0; m < (selection.quick ? 2 : family.size()); ++m) {
            choices.push_back(
                {symgen::AssociationId::parse(fmt::format("{}-{}-{}-none", law, name, quadrature)),
                 family[m], solvers[s]});
          }
        }
      }
    }
  }
  return choices;
}

}  // namespace elastogen::selector
