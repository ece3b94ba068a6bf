// Meshes that were numbered without thought: found, and computed along a curve with the same
// results at the same nodes and elements.
#include "runtime/mesh_order.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

/// The same body with nodes and elements at random.
Mesh shuffled(const Mesh& mesh) {
  std::mt19937 generator(1);
  std::vector<std::int32_t> node(mesh.num_nodes()), element(mesh.num_elements());
  for (auto* numbers : {&node, &element}) {
    std::iota(numbers->begin(), numbers->end(), 0);
    std::shuffle(numbers->begin(), numbers->end(), generator);
  }
  Mesh result = mesh;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    result.positions[3 * static_cast<std::size_t>(node[k / 3]) + k % 3] = mesh.positions[k];
  }
  result.blocks[0].nodes.clear();
  for (const std::int32_t e : element) {
    for (const std::int32_t a : mesh.blocks[0].element_nodes(static_cast<std::size_t>(e))) {
      result.blocks[0].nodes.push_back(node[static_cast<std::size_t>(a)]);
    }
  }
  return result;
}

/// More nodes than fit into a second cache.
Mesh large_bar(const std::string& element) { return bar_mesh(element, {40, 17, 17}, {3, 1, 1}); }

struct Results {
  Vector forces, product;
  double energy = 0;
  std::vector<double> element_energies, blocks;
  Eigen::SparseMatrix<double> stiffness;
};

Results results_of(Model& model, const Vector& u, const Vector& v) {
  Results r;
  r.forces = Vector::Zero(u.size());
  r.product = Vector::Zero(u.size());
  model.forces(u, r.forces);
  r.energy = model.energy(u);
  model.element_energies(u, r.element_energies);
  model.linearize(u);
  model.product(v, 2.0, r.product);
  model.diagonal_blocks(r.blocks);
  model.assemble(r.stiffness);
  return r;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  const Eigen::Map<const Vector> x(a.data(), static_cast<Eigen::Index>(a.size()));
  const Eigen::Map<const Vector> y(b.data(), static_cast<Eigen::Index>(b.size()));
  return (x - y).norm() / y.norm();
}

class ReorderedModel : public testing::TestWithParam<ModelOptions> {};

TEST_P(ReorderedModel, GivesTheSameAtTheSameNodesAndElements) {
  const Mesh mesh = shuffled(large_bar("tet4"));
  const auto table = ReferenceKernels<Tet4, 8, false>::table();
  ModelOptions options = GetParam();
  options.share_constants = false;  // or a shape's constants are those of another element
  Model along(mesh, one_part(mesh, table), options);
  options.reorder = false;
  Model plain(mesh, one_part(mesh, table), options);
  ASSERT_TRUE(along.is_reordered());
  ASSERT_FALSE(plain.is_reordered());

  const Vector u = 1e-3 * Vector::Random(static_cast<Eigen::Index>(mesh.positions.size()));
  const Vector v = Vector::Random(u.size());
  const Results a = results_of(along, u, v), b = results_of(plain, u, v);
  const double bound = 1e-13;  // other order of at most 24 terms
  EXPECT_LT((a.forces - b.forces).norm(), bound * b.forces.norm());
  EXPECT_LT((a.product - b.product).norm(), bound * b.product.norm());
  EXPECT_NEAR(a.energy, b.energy, bound * b.energy);
  EXPECT_EQ(a.element_energies, b.element_energies);
  EXPECT_LT(distance(a.blocks, b.blocks), bound);
  EXPECT_LT((a.stiffness - b.stiffness).norm(), bound * b.stiffness.norm());
  for (const auto& [measured, expected] : {std::pair{along.nodal_mass(), plain.nodal_mass()},
                                           {along.lumped_mass(), plain.lumped_mass()},
                                           {along.element_volumes(), plain.element_volumes()}}) {
    EXPECT_LT(distance({measured.begin(), measured.end()}, {expected.begin(), expected.end()}),
              bound);
  }
}

INSTANTIATE_TEST_SUITE_P(
    MeshOrder, ReorderedModel,
    testing::Values(ModelOptions{.threads = 1}, ModelOptions{.threads = 3},
                    ModelOptions{.threads = 2, .tangent_product = TangentProduct::two_stage},
                    ModelOptions{.threads = 1, .tangent_product = TangentProduct::assembled}),
    [](const auto& test) {
      return fmt::format("{}_threads_{}", test.param.threads,
                         static_cast<int>(test.param.tangent_product));
    });

TEST(MeshOrder, BadElementsAreNamedByTheNumbersOfTheMesh) {
  const Mesh mesh = shuffled(large_bar("tet4"));
  const auto table = ReferenceKernels<Tet4, 8, false>::table();
  Vector u = Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
  u[1234] = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> texts;
  for (const bool reorder : {true, false}) {
    Model model(mesh, one_part(mesh, table), {.threads = 2, .reorder = reorder});
    Vector forces = Vector::Zero(u.size());
    model.forces(u, forces);
    ASSERT_FALSE(model.status().ok());
    texts.push_back(model.describe(model.status()));
  }
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_NE(texts[0].find("411"), std::string::npos) << texts[0];  // the node
}

TEST(MeshOrder, OrderedAndSmallMeshesAreLeftAlone) {
  const auto is_left_alone = [](const Mesh& mesh) {
    std::vector<ModelPart> parts(1);
    parts[0].elements.resize(mesh.num_elements());
    std::iota(parts[0].elements.begin(), parts[0].elements.end(), 0);
    return !is_scattered(mesh, parts);
  };
  EXPECT_TRUE(is_left_alone(large_bar("tet4")));
  EXPECT_TRUE(is_left_alone(large_bar("hexa8")));
  EXPECT_TRUE(is_left_alone(shuffled(bar_mesh("tet4", {20, 10, 10}, {2, 1, 1}))));
  EXPECT_FALSE(is_left_alone(shuffled(bar_mesh("hexa8", {80, 17, 17}, {6, 1, 1}))));
}

TEST(MeshOrder, TheCurveKeepsEveryElementAndBringsNeighboursTogether) {
  const Mesh mesh = shuffled(bar_mesh("tet4", {24, 6, 6}, {4, 1, 1}));
  std::vector<ModelPart> parts(2);
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh.num_elements()); ++e) {
    parts[static_cast<std::size_t>(e % 3 == 0)].elements.push_back(e);
  }
  const std::vector<ModelPart> result = along_curve(mesh, parts);
  const auto mean_step = [&](const ModelPart& part) {
    double sum = 0;
    for (std::size_t k = 1; k < part.elements.size(); ++k) {
      const auto first_node = [&](std::size_t at) {
        const auto e = static_cast<std::size_t>(part.elements[at]);
        return 3 * static_cast<std::size_t>(mesh.blocks[0].element_nodes(e)[0]);
      };
      sum += std::abs(mesh.positions[first_node(k)] - mesh.positions[first_node(k - 1)]);
    }
    return sum / static_cast<double>(part.elements.size());
  };
  for (std::size_t p = 0; p < 2; ++p) {
    std::vector<std::int32_t> elements = result[p].elements;
    std::sort(elements.begin(), elements.end());
    EXPECT_EQ(elements, parts[p].elements);
    EXPECT_LT(mean_step(result[p]), 0.2 * mean_step(parts[p]));
  }
}

}  // namespace
}  // namespace elastogen::test
