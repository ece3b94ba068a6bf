#include "symgen/element/check_element.h"

#include <fmt/format.h>

#include <sstream>

namespace elastogen::symgen {
namespace {

std::string text(const GiNaC::ex& expression) {
  std::ostringstream out;
  out << expression;
  return out.str();
}

/// Limit of `function` at `point` along the last coordinate: the other coordinates are put in and
/// common factors cancelled before the last one.
GiNaC::ex limit_along_axis(const Element& element, const GiNaC::ex& function,
                           const std::vector<GiNaC::ex>& point) {
  const std::size_t last = point.size() - 1;
  GiNaC::exmap across;
  for (std::size_t i = 0; i < last; ++i) across[element.coordinates[i]] = point[i];
  return function.subs(across).normal().subs(element.coordinates[last] == point[last]);
}

GiNaC::matrix jacobian_of_reference_shape(const Element& element) {
  const auto dim = static_cast<unsigned>(element.dim);
  const std::vector<std::vector<GiNaC::ex>> gradients = shape_gradients(element);
  GiNaC::matrix jacobian(dim, dim);
  for (unsigned i = 0; i < dim; ++i) {
    for (unsigned j = 0; j < dim; ++j) {
      GiNaC::ex sum = 0;
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        sum += element.nodes[a][i] * gradients[a][j];
      }
      jacobian(i, j) = sum.normal();
    }
  }
  return jacobian;
}

}  // namespace

std::vector<std::string> check_element(const Element& element) {
  std::vector<std::string> violations;
  if (element.shape_functions.size() != element.nodes.size()) {
    violations.push_back(fmt::format("{} functions for {} nodes", element.shape_functions.size(),
                                     element.nodes.size()));
    return violations;
  }
  GiNaC::ex sum = 0;
  for (const GiNaC::ex& function : element.shape_functions) sum += function;
  if (!(sum - 1).normal().is_zero()) {
    violations.push_back(fmt::format("the functions sum to {}, must be 1", text(sum.normal())));
  }
  for (std::size_t a = 0; a < element.nodes.size(); ++a) {
    for (std::size_t b = 0; b < element.nodes.size(); ++b) {
      const GiNaC::ex value =
          limit_along_axis(element, element.shape_functions[a], element.nodes[b]);
      const int required = a == b ? 1 : 0;
      if (!(value - required).is_zero()) {
        violations.push_back(
            fmt::format("Lambda_{} is {} at node {}, must be {}", a, text(value), b, required));
      }
    }
  }
  for (std::size_t i = 0; i < element.coordinates.size(); ++i) {
    GiNaC::ex position = 0;
    for (std::size_t a = 0; a < element.nodes.size(); ++a) {
      position += element.shape_functions[a] * element.nodes[a][i];
    }
    if (!(position - element.coordinates[i]).normal().is_zero()) {
      violations.push_back(fmt::format("{} is interpolated as {}", text(element.coordinates[i]),
                                       text(position.normal())));
    }
  }
  const GiNaC::ex determinant = jacobian_of_reference_shape(element).determinant().normal();
  if (!determinant.info(GiNaC::info_flags::positive)) {
    violations.push_back(fmt::format("the Jacobian of the reference shape is {}, must be positive",
                                     text(determinant)));
  }
  return violations;
}

}  // namespace elastogen::symgen
