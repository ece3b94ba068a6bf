#include "symgen/quadrature/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/error.h"
#include "symgen/quadrature/exact_value.h"
#include "symgen/quadrature/line_rules.h"
#include "symgen/quadrature/product_rules.h"
#include "symgen/quadrature/reference_integral.h"
#include "symgen/quadrature/simplex_rules.h"
#include "symgen/quadrature/verify_quadrature.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

using Positions = std::vector<std::vector<ex>>;

/// The reference nodes moved by up to 3/20 in a pattern without symmetry.
Positions distorted_positions(const Element& element) {
  Positions positions = element.nodes;
  int step = 1;
  for (std::vector<ex>& position : positions) {
    for (ex& component : position) {
      component += numeric(step % 7 - 3, 20);
      step = (5 * step + 3) % 23;
    }
  }
  return positions;
}

struct Case {
  std::string element, quadrature;
  int num_points, degree;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.element << "-" << c.quadrature; }

class EveryRule : public testing::TestWithParam<Case> {
 protected:
  const Element& element() const { return find_element(GetParam().element); }
  const Quadrature& rule() const {
    return find_quadrature(GetParam().element, GetParam().quadrature);
  }
};

const std::vector<Case> all_cases = {
    {"tri3", "q1", 1, 1},     {"tri3", "q3", 3, 2},     {"tri3", "exact", 1, 1},
    {"quad4", "q4", 4, 3},    {"quad4", "q9", 9, 5},    {"tet4", "q1", 1, 1},
    {"tet4", "q4", 4, 2},     {"tet4", "exact", 1, 1},  {"hexa8", "q8", 8, 3},
    {"hexa8", "q27", 27, 5},  {"prism6", "q6", 6, 2},   {"prism6", "q21", 21, 5},
    {"pyramid5", "q5", 5, 2}, {"pyramid5", "q8", 8, 3}, {"tet10", "q4", 4, 2},
    {"tet10", "q15", 15, 5},  {"hexa20", "q8", 8, 3},   {"hexa20", "q27", 27, 5}};

bool is_quadratic(const Element& element) { return !element.edges.empty(); }

/// Nodes in the middle of edges put back there.
Positions straightened(const Element& element, Positions positions) {
  const std::size_t corners = positions.size() - element.edges.size();
  for (std::size_t k = 0; k < element.edges.size(); ++k) {
    const auto [a, b] = element.edges[k];
    for (std::size_t i = 0; i < positions[a].size(); ++i) {
      positions[corners + k][i] = (positions[a][i] + positions[b][i]) / 2;
    }
  }
  return positions;
}

/// Mass matrices of the reference shape, as projections onto nodes take them at
/// KernelTable::rich_points.
TEST(RichestRule, IntegratesProductsOfTwoShapeFunctions) {
  for (const std::string& name : element_names()) {
    SCOPED_TRACE(name);
    const Element& element = find_element(name);
    const Quadrature& rule = richest_quadrature(name);
    const ex& first = element.shape_functions.front();
    for (const ex& other : {first, element.shape_functions[1], element.shape_functions.back()}) {
      const ex product = (first * other).normal();
      ExactNumber sum;
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        GiNaC::exmap at;
        for (std::size_t k = 0; k < element.coordinates.size(); ++k) {
          at[element.coordinates[k]] = rule.points[g][k];
        }
        sum = sum + exact_value(rule.weights[g]) * exact_value(product.subs(at));
      }
      EXPECT_EQ(sum, exact_value(integrate_over_reference(element, product)));
    }
  }
}

TEST_P(EveryRule, HasItsPointsInsideAndPositiveWeights) {
  EXPECT_EQ(rule().num_points(), GetParam().num_points);
  ASSERT_EQ(rule().points.size(), rule().weights.size());
  for (std::size_t g = 0; g < rule().weights.size(); ++g) {
    EXPECT_GT(exact_value(rule().weights[g]).to_double(), 0);
    // Inside of these shapes every shape function of a vertex element is positive; quadratic
    // elements have the shapes of vertex elements.
    const Element& shape = find_element(GetParam().element == "tet10"    ? "tet4"
                                        : GetParam().element == "hexa20" ? "hexa8"
                                                                         : GetParam().element);
    GiNaC::exmap point;
    for (std::size_t i = 0; i < shape.coordinates.size(); ++i)
      point[shape.coordinates[i]] = rule().points[g][i];
    for (const ex& function : shape.shape_functions) {
      EXPECT_GT(exact_value(function.subs(point)).to_double(), 0) << "point " << g;
    }
  }
}

TEST_P(EveryRule, HasItsDegreeAndNoHigherOne) {
  EXPECT_EQ(polynomial_degree(element(), rule(), 6), GetParam().degree);
}

TEST_P(EveryRule, IntegratesShapeGradientsOnAnyDistortedElement) {
  if (is_quadratic(element())) return;  // see QuadraticRules
  EXPECT_TRUE(integrates_shape_gradients(element(), rule()));
}

TEST_P(EveryRule, LeavesOnlyRigidMotionsFree) {
  const int dim = element().dim;
  int required = dim * element().num_nodes() - dim * (dim + 1) / 2;
  // Six strains at each point: reduced integration of 20 nodes leaves six modes.
  if (is_quadratic(element())) required = std::min(required, 6 * rule().num_points());
  EXPECT_EQ(stiffness_rank(element(), rule(), element().nodes), required);
  EXPECT_EQ(stiffness_rank(element(), rule(), distorted_positions(element())), required);
}

INSTANTIATE_TEST_SUITE_P(Rules, EveryRule, testing::ValuesIn(all_cases),
                         [](const auto& c) { return c.param.element + "_" + c.param.quadrature; });

TEST(Quadratures, AreAllTested) {
  std::size_t num_offered = 0;
  for (const std::string& element : element_names()) {
    for (const std::string& name : quadrature_names(element)) {
      EXPECT_EQ(find_quadrature(element, name).name, name);
      EXPECT_EQ(std::count_if(
                    all_cases.begin(), all_cases.end(),
                    [&](const Case& c) { return c.element == element && c.quadrature == name; }),
                1)
          << element << "-" << name;
      ++num_offered;
    }
  }
  EXPECT_EQ(num_offered, all_cases.size());
}

TEST(Quadratures, RichestRulesIntegrateNodalVolumesOnAnyDistortedElement) {
  for (const std::string& name : element_names()) {
    if (is_quadratic(find_element(name))) continue;  // see QuadraticRules
    EXPECT_TRUE(integrates_nodal_volumes(find_element(name), richest_quadrature(name))) << name;
  }
  EXPECT_EQ(richest_quadrature("tri3").name, "q3");
  EXPECT_EQ(richest_quadrature("quad4").name, "q9");
  EXPECT_EQ(richest_quadrature("tet4").name, "q4");
  EXPECT_EQ(richest_quadrature("hexa8").name, "q27");
  EXPECT_EQ(richest_quadrature("prism6").name, "q21");
  EXPECT_EQ(richest_quadrature("pyramid5").name, "q8");
  EXPECT_EQ(richest_quadrature("tet10").name, "q15");
  EXPECT_EQ(richest_quadrature("hexa20").name, "q27");
}

/// sum of w_g cof(J) grad Lambda_a over the rest shape, component i of node a at [3 a + i], then
/// sum of w_g det J Lambda_a.
std::vector<ExactNumber> integrals(const Element& element, const Quadrature& rule,
                                   const Positions& rest) {
  const std::vector<std::vector<ex>> gradients = shape_gradients(element);
  const std::size_t n = rest.size();
  std::vector<ExactNumber> sums(4 * n, ExactNumber(0));
  for (std::size_t g = 0; g < rule.weights.size(); ++g) {
    GiNaC::exmap point;
    for (std::size_t i = 0; i < 3; ++i) point[element.coordinates[i]] = rule.points[g][i];
    std::vector<std::vector<ExactNumber>> slopes(n), jacobian(3, std::vector<ExactNumber>(3));
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t j = 0; j < 3; ++j) {
        slopes[a].push_back(exact_value(gradients[a][j].subs(point)));
        for (std::size_t i = 0; i < 3; ++i) {
          jacobian[i][j] = jacobian[i][j] + exact_value(rest[a][i]) * slopes[a][j];
        }
      }
    }
    const auto cofactor = [&](std::size_t i, std::size_t j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      return jacobian[i1][j1] * jacobian[i2][j2] + -(jacobian[i1][j2] * jacobian[i2][j1]);
    };
    const ExactNumber weight = exact_value(rule.weights[g]);
    ExactNumber determinant(0);
    for (std::size_t j = 0; j < 3; ++j) {
      determinant = determinant + jacobian[0][j] * cofactor(0, j);
      for (std::size_t i = 0; i < 3; ++i) {
        const ExactNumber scaled = weight * cofactor(i, j);
        for (std::size_t a = 0; a < n; ++a) {
          sums[3 * a + i] = sums[3 * a + i] + scaled * slopes[a][j];
        }
      }
    }
    for (std::size_t a = 0; a < n; ++a) {
      const ExactNumber shape = exact_value(element.shape_functions[a].subs(point));
      sums[3 * n + a] = sums[3 * n + a] + weight * determinant * shape;
    }
  }
  return sums;
}

/// A rule that no element offers, of any degree that is asked for here: Gauss-Lobatto's 5 points
/// (degree 7) in each direction; of tetrahedra the offered one is degree 5, which is enough.
Quadrature rich_rule(const Element& element) {
  if (element.shape == ReferenceShape::tetrahedron) return tetrahedron_rule(15);
  Quadrature line;
  const ex root = GiNaC::sqrt(ex(numeric(3, 7)));
  line.points = {{-1}, {-root}, {0}, {root}, {1}};
  line.weights = {numeric(1, 10), numeric(49, 90), numeric(32, 45), numeric(49, 90),
                  numeric(1, 10)};
  return tensor_product(line, tensor_product(line, line));
}

// In numbers, on one distorted element of each kind: the symbolic proof has thousands of
// determinants here. Degrees: with straight edges cof(J) grad Lambda has degree 1 on a tet10 and 3
// in each coordinate on a hexa20; with curved ones 3 and 5, and det J Lambda_a 5 and 7.
TEST(QuadraticRules, IntegrateGradientsAndVolumesOnDistortedElements) {
  const auto agree = [](const std::vector<ExactNumber>& one, const std::vector<ExactNumber>& other,
                        std::size_t first, std::size_t last) {
    return std::equal(one.begin() + static_cast<std::ptrdiff_t>(first),
                      one.begin() + static_cast<std::ptrdiff_t>(last),
                      other.begin() + static_cast<std::ptrdiff_t>(first));
  };
  for (const char* name : {"tet10", "hexa20"}) {
    SCOPED_TRACE(name);
    const Element& element = find_element(name);
    const std::size_t n = element.nodes.size();
    const Positions curved = distorted_positions(element);
    const Positions straight = straightened(element, curved);
    const Quadrature& reduced = find_quadrature(name, quadrature_names(name).front());
    const Quadrature& full = richest_quadrature(name);
    const auto exact_straight = integrals(element, rich_rule(element), straight);
    const auto exact_curved = integrals(element, rich_rule(element), curved);
    EXPECT_TRUE(agree(integrals(element, reduced, straight), exact_straight, 0, 3 * n));
    EXPECT_FALSE(agree(integrals(element, reduced, curved), exact_curved, 0, 3 * n));
    const auto by_full = integrals(element, full, curved);
    EXPECT_TRUE(agree(by_full, exact_curved, 0, 3 * n));
    EXPECT_TRUE(agree(integrals(element, full, straight), exact_straight, 0, 4 * n));
    // The volume is exact at least; of tet10 its shares, too.
    ExactNumber volume(0), exact_volume(0);
    for (std::size_t a = 3 * n; a < 4 * n; ++a) {
      volume = volume + by_full[a];
      exact_volume = exact_volume + exact_curved[a];
    }
    EXPECT_TRUE(volume == exact_volume);
    EXPECT_EQ(agree(by_full, exact_curved, 3 * n, 4 * n),
              element.shape == ReferenceShape::tetrahedron);
  }
}

TEST(Quadratures, ExactRuleIsForPolynomialLawsOnly) {
  const Quadrature& exact = find_quadrature("tet4", "exact");
  EXPECT_TRUE(exact.polynomial_laws_only);
  EXPECT_EQ(exact.weights.front(), ex(numeric(1, 6)));
  EXPECT_FALSE(find_quadrature("tet4", "q1").polynomial_laws_only);
}

TEST(Quadratures, FivePointPyramidHasThePublishedDecimals) {
  const Quadrature& rule = find_quadrature("pyramid5", "q5");
  EXPECT_DOUBLE_EQ(exact_value(rule.points[0][2]).to_double(), 0.1531754163448146);
  EXPECT_DOUBLE_EQ(exact_value(rule.points[4][2]).to_double(), 0.6372983346207416);
}

TEST(FindQuadrature, SuggestsNearestName) {
  try {
    (void)find_quadrature("hexa8", "q9");
    FAIL() << "q9 was found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown quadrature 'q9' of element 'hexa8'; did you mean 'q8'?; it has q8, q27");
  }
  EXPECT_THROW((void)quadrature_names("hexa9"), InputError);
}

// Rules that are too poor must fail the checks, or these prove nothing.
TEST(StiffnessRank, FindsZeroEnergyModesOfReducedIntegration) {
  const Element& hexa8 = find_element("hexa8");
  Quadrature one_point =
      tensor_product(gauss_legendre(1), tensor_product(gauss_legendre(1), gauss_legendre(1)));
  EXPECT_EQ(stiffness_rank(hexa8, one_point, hexa8.nodes), 6);
  EXPECT_EQ(stiffness_rank(hexa8, one_point, distorted_positions(hexa8)), 6);
  EXPECT_FALSE(integrates_shape_gradients(hexa8, one_point));

  const Element& quad4 = find_element("quad4");
  one_point = tensor_product(gauss_legendre(1), gauss_legendre(1));
  EXPECT_EQ(stiffness_rank(quad4, one_point, quad4.nodes), 3);

  const Element& prism6 = find_element("prism6");
  const Quadrature two_points = tensor_product(gauss_legendre(2), triangle_rule(1));
  EXPECT_LT(stiffness_rank(prism6, two_points, prism6.nodes), 12);
}

TEST(IntegratesShapeGradients, FindsWrongWeight) {
  Quadrature rule = find_quadrature("pyramid5", "q5");
  rule.weights[0] += numeric(1, 1000);
  EXPECT_FALSE(integrates_shape_gradients(find_element("pyramid5"), rule));
}

TEST(ReferenceIntegral, KnowsVolumesAndMoments) {
  const ex x = reference_coordinates()[0];
  const ex y = reference_coordinates()[1];
  const ex z = reference_coordinates()[2];
  const auto integral = [](const char* element, const ex& function) {
    return integrate_over_reference(find_element(element), function);
  };
  EXPECT_EQ(integral("tri3", 1), ex(numeric(1, 2)));
  EXPECT_EQ(integral("tri3", x * y), ex(numeric(1, 24)));
  EXPECT_EQ(integral("quad4", x * x), ex(numeric(4, 3)));
  EXPECT_EQ(integral("tet4", 1), ex(numeric(1, 6)));
  EXPECT_EQ(integral("hexa8", 1), ex(8));
  EXPECT_EQ(integral("prism6", 1), ex(1));
  EXPECT_EQ(integral("pyramid5", 1), ex(numeric(2, 3)));
  EXPECT_EQ(integral("tet4", x * y), ex(numeric(1, 120)));
  EXPECT_EQ(integral("prism6", x * x * y), ex(numeric(1, 9)));
  EXPECT_EQ(integral("pyramid5", x * x), ex(numeric(1, 15)));
  // A rational function of the pyramid: x^2/(1 - z) integrates u^2 (1 - z)^3 in conical
  // coordinates, 1/3 times 1/4.
  EXPECT_EQ(integral("pyramid5", x * x / (1 - z)), ex(numeric(1, 12)));
  EXPECT_THROW((void)integral("tet4", 1 / (1 + x)), InternalError);
}

// Distorted element with numbers in place of the general proof: the gradients' integral over the
// rest shape is the same with a rule as with a much richer one.
TEST(IntegratesShapeGradients, AgreesWithNumbersOnADistortedPyramid) {
  const Element& element = find_element("pyramid5");
  const Positions rest = distorted_positions(element);
  const std::vector<std::vector<ex>> gradients = shape_gradients(element);
  const auto integral = [&](const Quadrature& rule, std::size_t node, unsigned component) {
    ExactNumber sum(0);
    for (std::size_t g = 0; g < rule.weights.size(); ++g) {
      GiNaC::exmap point;
      for (std::size_t i = 0; i < 3; ++i) point[element.coordinates[i]] = rule.points[g][i];
      std::vector<std::vector<ExactNumber>> jacobian(3, std::vector<ExactNumber>(3));
      std::vector<std::vector<ExactNumber>> reference(rest.size());
      for (std::size_t a = 0; a < rest.size(); ++a) {
        for (std::size_t j = 0; j < 3; ++j) {
          reference[a].push_back(exact_value(gradients[a][j].subs(point)));
          for (std::size_t i = 0; i < 3; ++i) {
            jacobian[i][j] = jacobian[i][j] + exact_value(rest[a][i]) * reference[a][j];
          }
        }
      }
      const unsigned i1 = (component + 1) % 3, i2 = (component + 2) % 3;
      for (unsigned j = 0; j < 3; ++j) {
        const unsigned j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const ExactNumber cofactor =
            jacobian[i1][j1] * jacobian[i2][j2] + -(jacobian[i1][j2] * jacobian[i2][j1]);
        sum = sum + exact_value(rule.weights[g]) * cofactor * reference[node][j];
      }
    }
    return sum;
  };
  for (std::size_t node = 0; node < 5; ++node) {
    for (unsigned component = 0; component < 3; ++component) {
      const ExactNumber coarse = integral(find_quadrature("pyramid5", "q5"), node, component);
      EXPECT_TRUE(coarse == integral(find_quadrature("pyramid5", "q8"), node, component));
      EXPECT_TRUE(coarse.is_rational());
    }
  }
}

TEST(ExactValue, RefusesWhatIsNoExactNumber) {
  EXPECT_THROW((void)exact_value(GiNaC::symbol("x")), InternalError);
  EXPECT_THROW((void)exact_value(ex(0.5)), InternalError);
  EXPECT_THROW((void)exact_value(GiNaC::pow(ex(2), numeric(1, 3))), InternalError);
  EXPECT_EQ(exact_value(1 / (1 + GiNaC::sqrt(ex(2)))).text(), "-1 + sqrt(2)");
}

TEST(RuleTables, HaveNoOtherSizes) {
  EXPECT_THROW((void)gauss_legendre(4), InternalError);
  EXPECT_THROW((void)triangle_rule(4), InternalError);
  EXPECT_THROW((void)tetrahedron_rule(5), InternalError);
}

}  // namespace
}  // namespace elastogen::symgen
