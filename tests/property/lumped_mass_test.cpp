// Masses of nodes: consistent for body loads, positive for inertia.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "bars.h"
#include "runtime/loads.h"
#include "symgen/element/element.h"
#include "symgen/pipeline.h"

namespace elastogen::test {
namespace {

constexpr double density = 1000;

double sum(std::span<const double> values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

class Masses : public ::testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> associations{GetParam()};
  bool is_quadratic =
      !symgen::find_element(symgen::AssociationId::parse(GetParam()).element).edges.empty();
};

TEST_P(Masses, ArePositiveAndAddUpOnAnyShape) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-0.03, 0.03);
  for (const bool distorted : {false, true}) {
    Mesh mesh = make_bar_mesh({4, 1, 1}, {8, 2, 2}, associations);
    for (double& x : mesh.positions) x += distorted ? shift(generator) : 0.0;
    const Model model(mesh, parts_of(mesh, associations, 1e6, 0.3, density));
    const double mass = density * sum(model.element_volumes());
    EXPECT_NEAR(sum(model.nodal_mass()), mass, 1e-12 * mass);
    EXPECT_NEAR(sum(model.lumped_mass()), mass, 1e-12 * mass);
    if (!distorted) {
      EXPECT_NEAR(mass, 4 * density, 1e-12 * mass);
    }
    for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
      EXPECT_GT(model.lumped_mass()[node], 0);
      if (!is_quadratic) {
        EXPECT_EQ(model.lumped_mass()[node], model.nodal_mass()[node]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, Masses,
                         ::testing::Values("stvk-tet4-q1-none", "stvk-hexa8-q8-none",
                                           "stvk-prism6-q6-none", "stvk-pyramid5-q5-none",
                                           "stvk-tet10-q4-none", "stvk-hexa20-q8-none"),
                         [](const auto& info) {
                           return symgen::AssociationId::parse(info.param).identifier();
                         });

/// Shares of a cube's or tetrahedron's mass at a corner and in the middle of an edge.
struct Shares {
  const char* association;
  double nodal_corner, nodal_edge, lumped_corner, lumped_edge;
};

// Integrals of the functions and of their squares over the reference shapes, in closed form.
TEST(QuadraticMasses, HaveTheKnownShares) {
  const std::vector<Shares> known = {
      {"stvk-tet10-q4-none", -1.0 / 20, 1.0 / 5, 1.0 / 36, 4.0 / 27},
      {"stvk-hexa20-q8-none", -1.0 / 8, 1.0 / 6, 7.0 / 248, 2.0 / 31}};
  for (const Shares& expected : known) {
    SCOPED_TRACE(expected.association);
    const symgen::AssociationId id = symgen::AssociationId::parse(expected.association);
    const symgen::Element& element = symgen::find_element(id.element);
    Mesh mesh;
    mesh.region_names = {"body"};
    ElementBlock block;
    block.element = id.element;
    block.nodes_per_element = element.num_nodes();
    block.region = {0};
    for (std::size_t a = 0; a < element.nodes.size(); ++a) {
      block.nodes.push_back(static_cast<std::int32_t>(a));
      for (const GiNaC::ex& x : element.nodes[a]) {
        mesh.positions.push_back(GiNaC::ex_to<GiNaC::numeric>(x).to_double());
      }
    }
    mesh.blocks.push_back(block);
    const Model model(mesh, parts_of(mesh, {expected.association}, 1e6, 0.3, density));
    const double mass = density * model.element_volumes()[0];
    const std::size_t corners = element.nodes.size() - element.edges.size();
    for (std::size_t a = 0; a < element.nodes.size(); ++a) {
      const bool corner = a < corners;
      EXPECT_NEAR(model.nodal_mass()[a] / mass,
                  corner ? expected.nodal_corner : expected.nodal_edge, 1e-14);
      EXPECT_NEAR(model.lumped_mass()[a] / mass,
                  corner ? expected.lumped_corner : expected.lumped_edge, 1e-14);
    }
    Vector weight = Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
    add_gravity(model, std::array{0.0, 0.0, -10.0}, weight);
    EXPECT_NEAR(weight[2], -10 * mass * expected.nodal_corner, 1e-11 * mass);
  }
}

}  // namespace
}  // namespace elastogen::test
