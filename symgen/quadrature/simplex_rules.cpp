#include "symgen/quadrature/simplex_rules.h"

#include <fmt/format.h>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// The points with one barycentric coordinate `apart` and all others `common`, as many as the
/// simplex has vertices, all of one weight.
void add_vertex_orbit(Quadrature& rule, std::size_t dim, const ex& common, const ex& apart,
                      const ex& weight) {
  for (std::size_t vertex = 0; vertex <= dim; ++vertex) {
    std::vector<ex> point(dim, common);
    if (vertex > 0) point[vertex - 1] = apart;
    rule.points.push_back(point);
    rule.weights.push_back(weight);
  }
}

/// The six points of a tetrahedron with two barycentric coordinates `low` and the others `high`.
void add_edge_orbit(Quadrature& rule, const ex& low, const ex& high, const ex& weight) {
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      std::vector<ex> barycentric(4, low);
      barycentric[a] = high;
      barycentric[b] = high;
      rule.points.emplace_back(barycentric.begin() + 1, barycentric.end());
      rule.weights.push_back(weight);
    }
  }
}

}  // namespace

Quadrature triangle_rule(int num_points) {
  Quadrature rule;
  if (num_points == 1) {
    rule.points = {{numeric(1, 3), numeric(1, 3)}};
    rule.weights = {numeric(1, 2)};
    return rule;
  }
  if (num_points == 3) {
    add_vertex_orbit(rule, 2, numeric(1, 6), numeric(2, 3), numeric(1, 6));
    return rule;
  }
  if (num_points == 7) {
    const ex root = GiNaC::sqrt(ex(15));
    rule.points = {{numeric(1, 3), numeric(1, 3)}};
    rule.weights = {numeric(9, 80)};
    add_vertex_orbit(rule, 2, numeric(2, 7) - root / 21, numeric(3, 7) + 2 * root / 21,
                     numeric(31, 480) - root / 2400);
    add_vertex_orbit(rule, 2, numeric(2, 7) + root / 21, numeric(3, 7) - 2 * root / 21,
                     numeric(31, 480) + root / 2400);
    return rule;
  }
  throw InternalError(fmt::format("no triangle rule of {} points", num_points));
}

Quadrature tetrahedron_rule(int num_points) {
  Quadrature rule;
  if (num_points == 1) {
    rule.points = {{numeric(1, 4), numeric(1, 4), numeric(1, 4)}};
    rule.weights = {numeric(1, 6)};
    return rule;
  }
  if (num_points == 4) {
    const ex root = GiNaC::sqrt(ex(5));
    add_vertex_orbit(rule, 3, numeric(1, 4) - root / 20, numeric(1, 4) + 3 * root / 20,
                     numeric(1, 24));
    return rule;
  }
  if (num_points == 15) {
    const ex root = GiNaC::sqrt(ex(15));
    rule.points = {{numeric(1, 4), numeric(1, 4), numeric(1, 4)}};
    rule.weights = {numeric(8, 405)};
    for (const ex& sign : {ex(1), ex(-1)}) {
      add_vertex_orbit(rule, 3, numeric(7, 34) - sign * root / 34,
                       numeric(13, 34) + 3 * sign * root / 34,
                       numeric(2665, 226800) + 14 * sign * root / 226800);
    }
    add_edge_orbit(rule, numeric(1, 4) - root / 20, numeric(1, 4) + root / 20, numeric(5, 567));
    return rule;
  }
  throw InternalError(fmt::format("no tetrahedron rule of {} points", num_points));
}

}  // namespace elastogen::symgen
