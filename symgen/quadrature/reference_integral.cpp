#include "symgen/quadrature/reference_integral.h"

#include <sstream>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::factorial;
using GiNaC::numeric;

/// Integral of x^n over [-1, 1].
ex interval_moment(int n) { return n % 2 == 0 ? numeric(2, n + 1) : numeric(0); }

/// Integral of x^a y^b over x, y >= 0, x + y <= 1.
ex triangle_moment(int a, int b) {
  return factorial(numeric(a)) * factorial(numeric(b)) / factorial(numeric(a + b + 2));
}

/// Integral of x^a y^b over |x| + |y| <= 1: four times that over the triangle if both are even.
ex diamond_moment(int a, int b) {
  if (a % 2 != 0 || b % 2 != 0) return 0;
  return 4 * triangle_moment(a, b);
}

/// Integral of the monomial with these exponents (c is 0 in the plane); the pyramid's in conical
/// coordinates (u, v, z), without their Jacobian.
ex moment(ReferenceShape shape, int a, int b, int c) {
  switch (shape) {
    case ReferenceShape::triangle:
      return triangle_moment(a, b);
    case ReferenceShape::quadrilateral:
      return interval_moment(a) * interval_moment(b);
    case ReferenceShape::tetrahedron:
      return factorial(numeric(a)) * factorial(numeric(b)) * factorial(numeric(c)) /
             factorial(numeric(a + b + c + 3));
    case ReferenceShape::hexahedron:
      return interval_moment(a) * interval_moment(b) * interval_moment(c);
    case ReferenceShape::prism:
      return interval_moment(a) * triangle_moment(b, c);
    case ReferenceShape::pyramid:
      return diamond_moment(a, b) / (c + 1);
  }
  throw InternalError("unknown reference shape");
}

}  // namespace

ex integrate_over_reference(const Element& element, const ex& function) {
  const std::vector<GiNaC::symbol> coordinates = reference_coordinates();  // functions in the plane
  const ex x = coordinates[0], y = coordinates[1], z = coordinates[2];     // do not have the last
  ex polynomial = function;
  if (element.shape == ReferenceShape::pyramid) {
    // The symbols xi and eta now stand for u and v.
    const GiNaC::exmap conical = {{x, (1 - z) * x}, {y, (1 - z) * y}};
    polynomial = (function.subs(conical) * GiNaC::pow(1 - z, 2)).normal();
  }
  polynomial = polynomial.expand();
  if (!polynomial.is_polynomial(GiNaC::lst{x, y, z})) {
    std::ostringstream message;
    message << "cannot integrate over " << element.name << " (no polynomial): " << function;
    throw InternalError(message.str());
  }
  ex sum = 0;
  for (int a = 0; a <= polynomial.degree(x); ++a) {
    const ex in_x = polynomial.coeff(x, a);
    for (int b = 0; b <= in_x.degree(y); ++b) {
      const ex in_xy = in_x.coeff(y, b);
      for (int c = 0; c <= in_xy.degree(z); ++c) {
        sum += in_xy.coeff(z, c) * moment(element.shape, a, b, c);
      }
    }
  }
  return sum;
}

}  // namespace elastogen::symgen
