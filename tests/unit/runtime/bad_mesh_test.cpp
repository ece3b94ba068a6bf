// What the model's constructor refuses, and how it says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/rest_geometry.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

struct BadCase {
  std::string name;
  std::string element;
  std::function<void(Mesh&, std::vector<ModelPart>&)> spoil;
  std::vector<std::string> expected;  ///< texts that the message must hold
};

class BadMesh : public testing::TestWithParam<BadCase> {};

TEST_P(BadMesh, IsRefusedWithWhatWhereAndRemedy) {
  const auto tet4 = ReferenceKernels<Tet4, 8, false>::table();
  const auto hexa8 = ReferenceKernels<Hexa8, 8, false>::table();
  Mesh mesh = bar_mesh(GetParam().element, {3, 1, 1}, {3, 1, 1});
  std::vector<ModelPart> parts = one_part(mesh, GetParam().element == "tet4" ? tet4 : hexa8);
  ASSERT_NO_THROW(Model(mesh, parts));
  GetParam().spoil(mesh, parts);
  try {
    const Model model(mesh, parts);
    FAIL() << "no error";
  } catch (const InputError& error) {
    for (const std::string& text : GetParam().expected) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos)
          << "'" << text << "' not in: " << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , BadMesh,
    testing::Values(
        BadCase{"inverted_tet4",
                "tet4",
                [](Mesh& mesh, auto&) {
                  auto& nodes = mesh.blocks[0].nodes;
                  std::swap(nodes[4 * 11], nodes[4 * 11 + 1]);
                  std::swap(nodes[4 * 13], nodes[4 * 13 + 1]);
                },
                {"element 11 (tet4, nodes", "inverted", "point 1 of 1", "-1", "order"}},
        BadCase{"inverted_hexa8",
                "hexa8",
                [](Mesh& mesh, auto&) {
                  for (int a = 0; a < 4; ++a) {
                    std::swap(mesh.blocks[0].nodes[8 + a], mesh.blocks[0].nodes[12 + a]);
                  }
                },
                {"element 1 (hexa8, nodes", "inverted"}},
        BadCase{"flat_tet4",
                "tet4",
                [](Mesh& mesh, auto&) {
                  auto& nodes = mesh.blocks[0].nodes;
                  nodes[3] = nodes[2];
                },
                {"element 0 (tet4, nodes", "degenerate", "remove it"}},
        BadCase{"needle_far_from_the_origin",
                "tet4",
                [](Mesh& mesh, auto&) {
                  for (double& x : mesh.positions) x = 1e3 + 1e-12 * x;
                },
                {"degenerate"}},
        BadCase{"node_number",
                "tet4",
                [](Mesh& mesh, auto&) { mesh.blocks[0].nodes[9] = 16; },
                {"element 2 (tet4)", "node number 16", "0 ... 15"}},
        BadCase{
            "position",
            "tet4",
            [](Mesh& mesh, auto&) { mesh.positions[7] = std::numeric_limits<double>::quiet_NaN(); },
            {"node 2: component 1", "nan"}},
        BadCase{"orphan_node",
                "tet4",
                [](Mesh& mesh, auto&) {
                  mesh.positions.insert(mesh.positions.end(), {0, 0, 0});
                },
                {"node 16 belongs to no element", "remove"}},
        BadCase{"uncovered_element",
                "tet4",
                [](Mesh&, auto& parts) { parts[0].elements.erase(parts[0].elements.begin() + 4); },
                {"element 4 (tet4)", "no material"}},
        BadCase{"element_twice",
                "tet4",
                [](Mesh&, auto& parts) {
                  parts.push_back(parts[0]);
                  parts[1].elements = {5};
                },
                {"element 5 (tet4)", "parts 0 and 1"}},
        BadCase{"wrong_element",
                "tet4",
                [](Mesh& mesh, auto&) { mesh.blocks[0].element = "quad4"; },
                {"quad4", "tet4", "stvk-reference"}},
        BadCase{"parameters",
                "tet4",
                [](Mesh&, auto& parts) { parts[0].parameters.pop_back(); },
                {"1 parameters given", "takes 2"}},
        BadCase{"infinite_parameter",
                "tet4",
                [](Mesh&, auto& parts) {
                  parts[0].parameters[1] = std::numeric_limits<double>::infinity();
                },
                {"parameter mu = inf"}},
        BadCase{
            "density", "tet4", [](Mesh&, auto& parts) { parts[0].density = -1; }, {"density -1"}}),
    [](const testing::TestParamInfo<BadCase>& info) { return info.param.name; });

TEST(KernelTable, OfAnotherAbiVersionIsRefused) {
  auto table = ReferenceKernels<Tet4, 8, false>::table();
  const Mesh mesh = bar_mesh("tet4", {1, 1, 1}, {1, 1, 1});
  table.abi_version += 1;
  EXPECT_THROW(Model(mesh, one_part(mesh, table)), InternalError);
  table.abi_version -= 1;
  table.lanes = 3;
  EXPECT_THROW(Model(mesh, one_part(mesh, table)), InternalError);
}

TEST(AxisAlignedBox, NeedsStraightAngles) {
  Mesh mesh = bar_mesh("hexa8", {1, 1, 1}, {3, 0.1, 2});
  EXPECT_EQ(box_node_order(mesh, mesh.blocks[0], 0), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  mesh.positions[0] += 1e-9;
  EXPECT_TRUE(box_node_order(mesh, mesh.blocks[0], 0).empty());
  mesh.positions[0] -= 1e-9;
  // Sheared: every node but one pair is in place.
  mesh.positions[3 * static_cast<std::size_t>(mesh.blocks[0].nodes[6])] += 0.1;
  EXPECT_TRUE(box_node_order(mesh, mesh.blocks[0], 0).empty());
  const Mesh tets = bar_mesh("tet4", {1, 1, 1}, {1, 1, 1});
  EXPECT_TRUE(box_node_order(tets, tets.blocks[0], 0).empty());
}

/// Turns about an axis of the reference hexahedron, as new orders of its nodes.
std::vector<std::int32_t> turned(const std::vector<std::int32_t>& n, int about) {
  if (about == 0) return {n[3], n[2], n[6], n[7], n[0], n[1], n[5], n[4]};
  return {n[1], n[2], n[3], n[0], n[5], n[6], n[7], n[4]};
}

TEST(AxisAlignedBox, IsFoundInAllTwentyFourOrders) {
  Mesh mesh = bar_mesh("hexa8", {1, 1, 1}, {3, 0.1, 2});
  const std::vector<std::int32_t> straight = mesh.blocks[0].nodes;
  std::set<std::vector<std::int32_t>> orders = {straight};
  for (std::size_t before = 0; before < orders.size();) {
    before = orders.size();
    for (const auto& order : std::set<std::vector<std::int32_t>>(orders)) {
      for (const int about : {0, 2}) orders.insert(turned(order, about));
    }
  }
  ASSERT_EQ(orders.size(), 24U);
  for (const std::vector<std::int32_t>& nodes : orders) {
    mesh.blocks[0].nodes = nodes;
    const std::vector<int> order = box_node_order(mesh, mesh.blocks[0], 0);
    ASSERT_EQ(order.size(), 8U);
    for (std::size_t a = 0; a < 8; ++a) {
      EXPECT_EQ(nodes[static_cast<std::size_t>(order[a])], straight[a]);
    }
    // Mirrored it is inside out, which must be refused and not mended.
    mesh.blocks[0].nodes = {nodes[4], nodes[5], nodes[6], nodes[7],
                            nodes[0], nodes[1], nodes[2], nodes[3]};
    EXPECT_TRUE(box_node_order(mesh, mesh.blocks[0], 0).empty());
  }
}

TEST(AxisAlignedBox, TurnedNodesGiveTheSameForces) {
  auto table = ReferenceKernels<Hexa8, 8, false>::table();
  std::array<VariantTable<double>, 2> variants = {table.variants[0], table.variants[0]};
  variants[1].geometry = "box";
  table.variants = variants.data();
  table.num_variants = 2;
  Mesh mesh = bar_mesh("hexa8", {2, 2, 2}, {1, 1, 1});
  const Vector u = random_vector(3 * mesh.num_nodes(), 0.05, 3);
  Model straight(mesh, one_part(mesh, table));
  Vector expected = Vector::Zero(u.size()), found = expected;
  straight.forces(u, expected);
  auto& all = mesh.blocks[0].nodes;
  for (std::size_t e = 0; e < 8; ++e) {
    std::vector<std::int32_t> nodes(&all[8 * e], &all[8 * e] + 8);
    for (std::size_t k = 0; k < e; ++k) nodes = turned(nodes, k % 2 == 0 ? 0 : 2);
    std::copy(nodes.begin(), nodes.end(), &all[8 * e]);
  }
  Model model(mesh, one_part(mesh, table));
  ASSERT_EQ(model.groups().size(), 1U);
  EXPECT_EQ(model.groups()[0].geometry, "box");
  model.forces(u, found);
  EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
}

}  // namespace
}  // namespace elastogen::test
