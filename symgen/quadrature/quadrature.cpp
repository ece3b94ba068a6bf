#include "symgen/quadrature/quadrature.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runtime/error.h"
#include "symgen/law/names.h"
#include "symgen/quadrature/line_rules.h"
#include "symgen/quadrature/product_rules.h"
#include "symgen/quadrature/simplex_rules.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// The rules of one element.
struct RuleSet {
  std::vector<Quadrature> offered;  ///< coarsest first
  std::vector<std::string> names;   ///< of `offered`
};

Quadrature named(std::string name, Quadrature rule) {
  rule.name = std::move(name);
  return rule;
}

Quadrature gauss_square(int num_points) {
  return tensor_product(gauss_legendre(num_points), gauss_legendre(num_points));
}

Quadrature conical_gauss(int num_points) {
  return conical_product(turned_onto_diamond(gauss_square(num_points)), gauss_jacobi_height());
}

/// Five points of equal weight, degree 2: four on the lines from the axis to the base's nodes.
/// Source: Code_Aster reference manual, R3.01.01, shape functions and integration points.
Quadrature five_point_pyramid() {
  const ex root = GiNaC::sqrt(ex(15));
  const ex low = numeric(1, 4) - root / 40;
  const ex high = numeric(1, 4) + root / 10;
  const ex half = numeric(1, 2);
  Quadrature rule;
  rule.points = {{half, 0, low}, {0, half, low}, {-half, 0, low}, {0, -half, low}, {0, 0, high}};
  rule.weights.assign(5, numeric(2, 15));
  return rule;
}

/// Gradients of linear functions are constant, so polynomial laws are integrated analytically.
Quadrature exact_on_simplex(const Element& element) {
  Quadrature rule = named("exact", analytic_rule(element));
  rule.polynomial_laws_only = true;
  return rule;
}

RuleSet make_rules(const Element& element) {
  RuleSet rules;
  switch (element.shape) {
    case ReferenceShape::triangle:
      rules.offered = {named("q1", triangle_rule(1)), named("q3", triangle_rule(3)),
                       exact_on_simplex(element)};
      break;
    case ReferenceShape::quadrilateral:
      rules.offered = {named("q4", gauss_square(2)), named("q9", gauss_square(3))};
      break;
    case ReferenceShape::tetrahedron:
      rules.offered =
          element.affine
              ? std::vector{named("q1", tetrahedron_rule(1)), named("q4", tetrahedron_rule(4)),
                            exact_on_simplex(element)}
              : std::vector{named("q4", tetrahedron_rule(4)), named("q15", tetrahedron_rule(15))};
      break;
    case ReferenceShape::hexahedron:
      rules.offered = {named("q8", tensor_product(gauss_square(2), gauss_legendre(2))),
                       named("q27", tensor_product(gauss_square(3), gauss_legendre(3)))};
      break;
    case ReferenceShape::prism:
      rules.offered = {named("q6", tensor_product(gauss_legendre(2), triangle_rule(3))),
                       named("q21", tensor_product(gauss_legendre(3), triangle_rule(7)))};
      break;
    case ReferenceShape::pyramid:
      rules.offered = {named("q5", five_point_pyramid()), named("q8", conical_gauss(2))};
      break;
  }
  for (const Quadrature& rule : rules.offered) rules.names.push_back(rule.name);
  return rules;
}

const RuleSet& rules_of(const std::string& element) {
  static const std::map<std::string, RuleSet> all = [] {
    std::map<std::string, RuleSet> result;
    for (const std::string& name : element_names()) {
      result.emplace(name, make_rules(find_element(name)));
    }
    return result;
  }();
  return all.at(find_element(element).name);
}

}  // namespace

const std::vector<std::string>& quadrature_names(const std::string& element) {
  return rules_of(element).names;
}

const Quadrature& find_quadrature(const std::string& element, const std::string& name) {
  const RuleSet& rules = rules_of(element);
  for (const Quadrature& rule : rules.offered) {
    if (rule.name == name) return rule;
  }
  throw InputError(fmt::format("unknown quadrature '{}' of element '{}'{}; it has {}", name,
                               element, suggestion(name, rules.names), join_names(rules.names)));
}

const Quadrature& richest_quadrature(const std::string& element) {
  // `exact` stands last where there is one, and is no rule for other functions than constants.
  const std::vector<Quadrature>& offered = rules_of(element).offered;
  return *std::find_if(offered.rbegin(), offered.rend(),
                       [](const Quadrature& rule) { return !rule.polynomial_laws_only; });
}

}  // namespace elastogen::symgen
