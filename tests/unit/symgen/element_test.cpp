#include "symgen/element/element.h"

#include <gtest/gtest.h>

#include <utility>

#include "runtime/error.h"
#include "symgen/element/check_element.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

class EveryElement : public testing::TestWithParam<std::string> {};

TEST_P(EveryElement, IsSound) {
  const std::vector<std::string> violations = check_element(find_element(GetParam()));
  EXPECT_TRUE(violations.empty()) << violations.front();
}

TEST_P(EveryElement, GradientsSumToZero) {
  const Element& element = find_element(GetParam());
  for (std::size_t i = 0; i < element.coordinates.size(); ++i) {
    ex sum = 0;
    for (const std::vector<ex>& gradient : shape_gradients(element)) sum += gradient[i];
    EXPECT_TRUE(sum.normal().is_zero()) << "coordinate " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElement, testing::ValuesIn(element_names()),
                         [](const auto& element) { return element.param; });

TEST(Elements, AreListedInOrder) {
  EXPECT_EQ(element_names(), (std::vector<std::string>{"tri3", "quad4", "tet4", "hexa8", "prism6",
                                                       "pyramid5", "tet10", "hexa20"}));
}

TEST(Elements, KnowTheirGeometryVariants) {
  EXPECT_TRUE(find_element("tri3").affine);
  EXPECT_TRUE(find_element("quad4").has_box);
  EXPECT_TRUE(find_element("tet4").affine);
  EXPECT_FALSE(find_element("tet4").has_box);
  EXPECT_TRUE(find_element("hexa8").has_box);
  EXPECT_TRUE(find_element("tet10").has_affine);
  EXPECT_TRUE(find_element("hexa20").has_box);
  for (const char* name : {"quad4", "hexa8", "prism6", "pyramid5", "tet10", "hexa20"})
    EXPECT_FALSE(find_element(name).affine);
}

// The functions as tables 3.1 to 3.3 of the thesis print them, in its order of nodes.
TEST(Elements, HavePrintedShapeFunctions) {
  const ex x = reference_coordinates()[0];
  const ex y = reference_coordinates()[1];
  const ex z = reference_coordinates()[2];
  const auto expect_equal = [](const std::string& name, const std::vector<ex>& functions) {
    const Element& element = find_element(name);
    ASSERT_EQ(element.shape_functions.size(), functions.size());
    for (std::size_t a = 0; a < functions.size(); ++a) {
      EXPECT_TRUE((element.shape_functions[a] - functions[a]).normal().is_zero())
          << name << " function " << a;
    }
  };
  expect_equal("tri3", {1 - x - y, x, y});
  expect_equal("quad4", {(1 - x) * (1 - y) / 4, (1 + x) * (1 - y) / 4, (1 + x) * (1 + y) / 4,
                         (1 - x) * (1 + y) / 4});
  expect_equal("tet4", {1 - x - y - z, x, y, z});
  expect_equal("hexa8", {(1 - x) * (1 - y) * (1 - z) / 8, (1 + x) * (1 - y) * (1 - z) / 8,
                         (1 + x) * (1 + y) * (1 - z) / 8, (1 - x) * (1 + y) * (1 - z) / 8,
                         (1 - x) * (1 - y) * (1 + z) / 8, (1 + x) * (1 - y) * (1 + z) / 8,
                         (1 + x) * (1 + y) * (1 + z) / 8, (1 - x) * (1 + y) * (1 + z) / 8});
  expect_equal("prism6", {y * (1 - x) / 2, z * (1 - x) / 2, (1 - y - z) * (1 - x) / 2,
                          y * (1 + x) / 2, z * (1 + x) / 2, (1 - y - z) * (1 + x) / 2});
  expect_equal("pyramid5", {(-x + y + z - 1) * (-x - y + z - 1) / (4 * (1 - z)),
                            (-x - y + z - 1) * (x - y + z - 1) / (4 * (1 - z)),
                            (x + y + z - 1) * (x - y + z - 1) / (4 * (1 - z)),
                            (x + y + z - 1) * (-x + y + z - 1) / (4 * (1 - z)), z});
}

TEST(Elements, HaveTheNodesOfQuadraticOnesBetweenTheEndsOfTheirEdges) {
  const std::vector<std::pair<std::string, std::string>> pairs = {{"tet10", "tet4"},
                                                                  {"hexa20", "hexa8"}};
  for (const auto& [quadratic, linear] : pairs) {
    const Element& element = find_element(quadratic);
    const std::size_t corners = find_element(linear).nodes.size();
    ASSERT_EQ(element.nodes.size(), corners + element.edges.size());
    for (std::size_t k = 0; k < element.edges.size(); ++k) {
      const auto [a, b] = element.edges[k];
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(2 * element.nodes[corners + k][i], element.nodes[a][i] + element.nodes[b][i]);
      }
    }
  }
}

TEST(CheckElement, FindsSwappedFunctions) {
  Element element = find_element("prism6");
  std::swap(element.shape_functions[0], element.shape_functions[1]);
  const std::vector<std::string> violations = check_element(element);
  ASSERT_FALSE(violations.empty());
  EXPECT_EQ(violations.front(), "Lambda_0 is 0 at node 0, must be 1");
}

TEST(CheckElement, FindsFunctionsThatDoNotSumToOne) {
  Element element = find_element("tet4");
  element.shape_functions[0] += element.coordinates[0];
  EXPECT_NE(check_element(element).front().find("sum to"), std::string::npos);
}

TEST(CheckElement, FindsMissingLinearCompleteness) {
  // Partition of unity and Kronecker still hold with a bubble moved from one node to another.
  Element element = find_element("hexa8");
  ex bubble = 1;
  for (const GiNaC::symbol& coordinate : element.coordinates) {
    bubble *= 1 - coordinate * coordinate;
  }
  element.shape_functions[0] += bubble;
  element.shape_functions[6] -= bubble;
  const std::vector<std::string> violations = check_element(element);
  ASSERT_FALSE(violations.empty());
  EXPECT_NE(violations.front().find("xi is interpolated as"), std::string::npos);
}

TEST(CheckElement, FindsInvertedReferenceShape) {
  Element element = find_element("tet4");
  std::swap(element.nodes[1], element.nodes[2]);
  std::string all;
  for (const std::string& violation : check_element(element)) all += violation + "\n";
  EXPECT_NE(all.find("Jacobian of the reference shape is -1"), std::string::npos) << all;
}

TEST(FindElement, SuggestsNearestName) {
  try {
    (void)find_element("hexa9");
    FAIL() << "hexa9 was found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown element 'hexa9'; did you mean 'hexa8'?; elements are tri3, quad4, "
                 "tet4, hexa8, prism6, pyramid5, tet10, hexa20");
  }
}

}  // namespace
}  // namespace elastogen::symgen
