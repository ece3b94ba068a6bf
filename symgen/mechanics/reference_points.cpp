#include "symgen/mechanics/reference_points.h"

#include <map>

#include "symgen/dag/lower.h"

namespace elastogen::symgen {

ReferencePoints reference_points(const Element& element, const Quadrature& quadrature) {
  const std::vector<std::vector<GiNaC::ex>> gradients = shape_gradients(element);
  ReferencePoints result;
  for (std::size_t g = 0; g < quadrature.points.size(); ++g) {
    result.weights.push_back(exact_value(quadrature.weights[g], {}).to_double());
    std::map<GiNaC::ex, ExactNumber, GiNaC::ex_is_less> at;
    for (std::size_t k = 0; k < element.coordinates.size(); ++k) {
      at[element.coordinates[k]] = exact_value(quadrature.points[g][k], {});
    }
    for (std::size_t a = 0; a < element.shape_functions.size(); ++a) {
      result.shapes.push_back(exact_value(element.shape_functions[a], at).to_double());
      for (const GiNaC::ex& derivative : gradients[a]) {
        result.gradients.push_back(exact_value(derivative, at).to_double());
      }
    }
  }
  return result;
}

}  // namespace elastogen::symgen
