#include "symgen/quadrature/line_rules.h"

#include <fmt/format.h>

#include "runtime/error.h"

namespace elastogen::symgen {

using GiNaC::ex;
using GiNaC::numeric;

Quadrature gauss_legendre(int num_points) {
  Quadrature rule;
  switch (num_points) {
    case 1:
      rule.points = {{0}};
      rule.weights = {2};
      return rule;
    case 2: {
      const ex a = GiNaC::sqrt(ex(3)) / 3;
      rule.points = {{-a}, {a}};
      rule.weights = {1, 1};
      return rule;
    }
    case 3: {
      const ex a = GiNaC::sqrt(ex(15)) / 5;
      rule.points = {{-a}, {0}, {a}};
      rule.weights = {numeric(5, 9), numeric(8, 9), numeric(5, 9)};
      return rule;
    }
    default:
      throw InternalError(fmt::format("no Gauss-Legendre rule of {} points", num_points));
  }
}

Quadrature gauss_jacobi_height() {
  const ex a = GiNaC::sqrt(ex(10)) / 15;  // sqrt(2/45)
  const ex b = GiNaC::sqrt(ex(10)) / 48;
  Quadrature rule;
  rule.points = {{numeric(1, 3) - a}, {numeric(1, 3) + a}};
  rule.weights = {numeric(1, 6) + b, numeric(1, 6) - b};
  return rule;
}

}  // namespace elastogen::symgen
