#include "symgen/quadrature/product_rules.h"

#include "symgen/quadrature/reference_integral.h"

namespace elastogen::symgen {

using GiNaC::ex;

Quadrature tensor_product(const Quadrature& first, const Quadrature& second) {
  Quadrature rule;
  for (std::size_t h = 0; h < second.weights.size(); ++h) {
    for (std::size_t g = 0; g < first.weights.size(); ++g) {
      std::vector<ex> point = first.points[g];
      point.insert(point.end(), second.points[h].begin(), second.points[h].end());
      rule.points.push_back(point);
      rule.weights.push_back(first.weights[g] * second.weights[h]);
    }
  }
  return rule;
}

Quadrature turned_onto_diamond(const Quadrature& square) {
  Quadrature rule;
  for (std::size_t g = 0; g < square.weights.size(); ++g) {
    const ex& a = square.points[g][0];
    const ex& b = square.points[g][1];
    rule.points.push_back({((a - b) / 2).expand(), ((a + b) / 2).expand()});
    rule.weights.push_back(square.weights[g] / 2);
  }
  return rule;
}

Quadrature conical_product(const Quadrature& base, const Quadrature& height) {
  Quadrature rule;
  for (std::size_t h = 0; h < height.weights.size(); ++h) {
    const ex& z = height.points[h][0];
    for (std::size_t g = 0; g < base.weights.size(); ++g) {
      rule.points.push_back(
          {((1 - z) * base.points[g][0]).expand(), ((1 - z) * base.points[g][1]).expand(), z});
      rule.weights.push_back((base.weights[g] * height.weights[h]).expand());
    }
  }
  return rule;
}

Quadrature analytic_rule(const Element& element) {
  const ex volume = integrate_over_reference(element, 1);
  Quadrature rule;
  rule.weights = {volume};
  rule.points.emplace_back();
  for (const GiNaC::symbol& coordinate : element.coordinates) {
    rule.points[0].push_back(integrate_over_reference(element, coordinate) / volume);
  }
  return rule;
}

}  // namespace elastogen::symgen
