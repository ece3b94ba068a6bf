// Model: batches, parts, geometry variants, dimensions; what it reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/model.h"
#include "tests/unit/each_batch.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

// Every count of elements around a full batch gives what one lane gives.
TEST(Model, PadsTheLastBatch) {
  const auto scalar = ReferenceKernels<Tet4, 1, false>::table();
  const auto batches = ReferenceKernels<Tet4, 8, false>::table();
  const Mesh whole = bar_mesh("tet4", {3, 1, 1}, {3, 1, 1});
  for (const std::size_t count : {1u, 7u, 8u, 9u, 17u}) {
    Mesh mesh = whole;
    mesh.blocks[0].nodes.resize(4 * count);
    mesh.blocks[0].region.resize(count);
    std::int32_t largest = 0;
    std::vector<std::int32_t> number(whole.num_nodes(), -1);
    mesh.positions.clear();
    for (std::int32_t& node : mesh.blocks[0].nodes) {
      const std::size_t old = static_cast<std::size_t>(node);
      if (number[old] < 0) {
        number[old] = largest++;
        mesh.positions.insert(mesh.positions.end(), whole.positions.begin() + 3 * node,
                              whole.positions.begin() + 3 * node + 3);
      }
      node = number[old];
    }
    Model a(mesh, one_part(mesh, scalar), {.threads = 1});
    Model b(mesh, one_part(mesh, batches), {.threads = 2});
    const Vector u = random_vector(a.num_dofs(), 0.05, 11);
    EXPECT_NEAR(a.energy(u), b.energy(u), 1e-13 * a.energy(u)) << count;
    Vector fa = Vector::Zero(u.size());
    Vector fb = Vector::Zero(u.size());
    a.forces(u, fa);
    b.forces(u, fb);
    EXPECT_LT((fa - fb).norm(), 1e-13 * fa.norm()) << count;
    Eigen::SparseMatrix<double> ka;
    Eigen::SparseMatrix<double> kb;
    a.assemble(ka);
    b.assemble(kb);
    EXPECT_LT((ka - kb).norm(), 1e-13 * ka.norm()) << count;
    EXPECT_EQ(b.groups()[0].num_batches, (count + 7) / 8);
  }
}

TEST(Model, TakesTheBoxVariantForBoxesOnly) {
  const auto table = ReferenceKernels<Hexa8, 8, false>::table(true);
  Mesh mesh = bar_mesh("hexa8", {2, 2, 2}, {1, 1, 1});
  {
    const Model model(mesh, one_part(mesh, table));
    ASSERT_EQ(model.groups().size(), 1u);
    EXPECT_EQ(model.groups()[0].geometry, "box");
    EXPECT_EQ(model.groups()[0].num_elements, 8u);
  }
  mesh.positions[2] += 0.1;  // a corner: one element
  const Model model(mesh, one_part(mesh, table));
  ASSERT_EQ(model.groups().size(), 2u);
  EXPECT_EQ(model.groups()[0].num_elements, 7u);
  EXPECT_EQ(model.groups()[1].geometry, "general");
  EXPECT_EQ(model.groups()[1].num_elements, 1u);
  const std::vector<std::int32_t> group = model.group_of_elements();
  EXPECT_EQ(group[0], 1);
  EXPECT_EQ(std::count(group.begin(), group.end(), 0), 7);
}

// A hexahedron and six tetrahedra with a face in common, of different density.
TEST(Model, SumsPartsOfDifferentElements) {
  const auto hexa = ReferenceKernels<Hexa8, 8, true>::table();
  const auto tet = ReferenceKernels<Tet4, 8, false>::table();
  Mesh mesh = bar_mesh("tet4", {2, 1, 1}, {2, 1, 1});
  const Mesh hexas = bar_mesh("hexa8", {2, 1, 1}, {2, 1, 1});
  ElementBlock& tets = mesh.blocks[0];
  tets.nodes.erase(tets.nodes.begin(), tets.nodes.begin() + 6 * 4);
  tets.region.resize(6);
  ElementBlock cube = hexas.blocks[0];
  cube.nodes.resize(8);
  cube.region.resize(1);
  mesh.blocks.push_back(cube);

  std::vector<ModelPart> parts = one_part(mesh, tet, 100);
  parts.push_back({1, {0}, &hexa, lame_parameters(), 300});
  for (const int threads : {1, 2, 3}) {
    Model model(mesh, parts, {.threads = threads});
    ASSERT_EQ(model.groups().size(), 2u);
    EXPECT_EQ(model.group_of_elements(), (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, 1}));
    double mass = 0;
    for (const double m : model.lumped_mass()) mass += m;
    EXPECT_NEAR(mass, 400, 1e-10);
    // Under x -> 1.1 x, unit cubes of either kind hold the same energy.
    Vector u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
    for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
      u[static_cast<Eigen::Index>(3 * node)] = 0.1 * mesh.positions[3 * node];
    }
    std::vector<double> energies;
    model.element_energies(u, energies);
    double tet_energy = 0;
    for (std::size_t e = 0; e < 6; ++e) tet_energy += energies[e];
    const double strain = 0.105;
    const double expected = (lame_parameters()[0] / 2 + lame_parameters()[1]) * strain * strain;
    EXPECT_NEAR(tet_energy, expected, 1e-12 * expected);
    EXPECT_NEAR(energies[6], expected, 1e-12 * expected);

    const Vector v = random_vector(model.num_dofs(), 1, 12);
    model.linearize(u);
    Vector df = Vector::Zero(v.size());
    model.product(v, 1, df);
    Eigen::SparseMatrix<double> k;
    model.assemble(k);
    EXPECT_LT((k * v + df).norm(), 1e-12 * df.norm());
  }
}

// Plane triangles on an elastic foundation: W = k / 2 sum |u_a|^2 per element.
struct Foundation {
  using Arguments = KernelArguments<double>;
  static constexpr int lanes = 8;
  static constexpr int size = 6;

  static void constants(const Arguments&) {}
  static void geometry_measures(const Arguments& args) {
    for (int l = 0; l < lanes; ++l) {
      const auto x = [&](int a, int i) { return args.positions[(2 * a + i) * lanes + l]; };
      const double det =
          (x(1, 0) - x(0, 0)) * (x(2, 1) - x(0, 1)) - (x(2, 0) - x(0, 0)) * (x(1, 1) - x(0, 1));
      for (int k = 0; k < 6; ++k) args.output[k * lanes + l] = det / 6;
      args.output[6 * lanes + l] = det;
    }
  }
  static void energy(const Arguments& args) {
    for (int l = 0; l < lanes; ++l) args.output[l] = 0;
    for (int k = 0; k < size * lanes; ++k) {
      args.output[k % lanes] +=
          args.parameters[0] / 2 * args.displacement[k] * args.displacement[k];
    }
  }
  static void forces(const Arguments& args) {
    for (int k = 0; k < size * lanes; ++k) {
      args.output[k] = -args.parameters[0] * args.displacement[k];
    }
  }
  static void stiffness(const Arguments& args) {
    for (int k = 0; k < size * size * lanes; ++k) {
      args.output[k] = (k / lanes) % (size + 1) == 0 ? args.parameters[0] : 0;
    }
  }
};

TEST(Model, WorksInThePlane) {
  const char* const names[] = {"k"};
  const VariantTable<double> variant = {"general",
                                        0,
                                        0,
                                        false,
                                        1,
                                        {1, 1, 1},
                                        each_batch<&Foundation::constants>,
                                        each_batch<&Foundation::geometry_measures>,
                                        each_batch<&Foundation::energy>,
                                        each_batch<&Foundation::forces>,
                                        nullptr,
                                        nullptr,
                                        nullptr,
                                        each_batch<&Foundation::stiffness>};
  const KernelTable<double> table = {kernel_abi_version,
                                     8,
                                     "foundation-tri3-q1-none",
                                     "tri3",
                                     "",
                                     "native",
                                     2,
                                     3,
                                     1,
                                     1,
                                     names,
                                     &kernel::nodal_pass<kernel::Pack<double, 8>, 3, 2>,
                                     1,
                                     &variant,
                                     {},
                                     {}};
  Mesh mesh;
  mesh.dim = 2;
  mesh.positions = {0, 0, 1, 0, 1, 1, 0, 1};
  mesh.region_names = {"plate"};
  mesh.blocks.push_back({"tri3", 3, {0, 1, 2, 0, 2, 3}, {0, 0}});
  const std::vector<ModelPart> parts = {{0, {0, 1}, &table, {10}, 6}};
  Model model(mesh, parts, {.threads = 2});
  ASSERT_EQ(model.num_dofs(), 8u);
  EXPECT_NEAR(model.lumped_mass()[0], 2, 1e-15);
  EXPECT_NEAR(model.lumped_mass()[1], 1, 1e-15);
  const Vector u = random_vector(8, 1, 13);
  // Nodes 0 and 2 belong to both triangles.
  const Vector expected = (Vector(8) << 20, 20, 10, 10, 20, 20, 10, 10).finished().cwiseProduct(-u);
  Vector f = Vector::Zero(8);
  model.forces(u, f);
  EXPECT_LT((f - expected).norm(), 1e-13);
  EXPECT_NEAR(model.energy(u), -u.dot(expected) / 2, 1e-13);
  Eigen::SparseMatrix<double> k;
  model.assemble(k);
  EXPECT_LT((k * u + expected).norm(), 1e-13);
  std::vector<double> blocks;
  model.diagonal_blocks(blocks);
  EXPECT_EQ(blocks, (std::vector<double>{20, 0, 0, 20, 10, 0, 0, 10, 20, 0, 0, 20, 10, 0, 0, 10}));
}

TEST(Model, UsesNoMoreThreadsThanPay) {
  const auto table = ReferenceKernels<Tet4, 8, false>::table();
  const Mesh small = bar_mesh("tet4", {2, 1, 1}, {2, 1, 1});
  EXPECT_EQ(Model(small, one_part(small, table)).num_threads(), 1);
  EXPECT_EQ(Model(small, one_part(small, table), {.threads = 3}).num_threads(), 3);
  EXPECT_THROW(Model(small, one_part(small, table), {.threads = -1}), InputError);
}

TEST(Model, CountsConstantsStateAndBytes) {
  const Mesh mesh = bar_mesh("tet4", {1, 1, 1}, {1, 1, 1});
  const auto stored = ReferenceKernels<Tet4, 8, false>::table();
  const GroupSummary a = Model(mesh, one_part(mesh, stored)).groups().at(0);
  EXPECT_EQ(a.num_constants, 13);
  EXPECT_EQ(a.num_state, 0);
  EXPECT_EQ(a.bytes_per_element, 4 * 4 + 13 * 8u);
  const auto positions = ReferenceKernels<Tet4, 8, true>::table();
  const ModelOptions two_stage = {.threads = 1, .tangent_product = TangentProduct::two_stage};
  const GroupSummary b = Model(mesh, one_part(mesh, positions), two_stage).groups().at(0);
  EXPECT_EQ(b.num_constants, 0);
  EXPECT_EQ(b.num_state, 9);
  EXPECT_EQ(b.bytes_per_element, 4 * 4 + (12 + 9) * 8u);
}

TEST(Model, ReportsTheFirstBadElement) {
  const auto table = ReferenceKernels<Tet4, 8, false>::table();
  const Mesh mesh = bar_mesh("tet4", {4, 1, 1}, {4, 1, 1});
  Model model(mesh, one_part(mesh, table), {.threads = 2});
  Vector u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  // Turn the far end inside out: the last cell's elements, 18 to 23.
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    if (mesh.positions[3 * node] > 3.5) u[static_cast<Eigen::Index>(3 * node)] = -2;
  }
  static_cast<void>(model.energy(u));
  ASSERT_FALSE(model.status().ok());
  EXPECT_EQ(model.status().flags, status_outside_domain);
  EXPECT_EQ(model.status().element, 18u);
  const std::string text = model.describe(model.status());
  EXPECT_NE(text.find("element 18 (tet4, nodes 12 16 18 19)"), std::string::npos) << text;
  EXPECT_NE(text.find("domain"), std::string::npos) << text;

  u[3] = std::nan("");  // node 1 belongs to the first cell
  static_cast<void>(model.energy(u));
  EXPECT_EQ(model.status().flags & status_not_finite, status_not_finite);
  EXPECT_LT(model.status().element, 6u);
  static_cast<void>(model.energy(Vector::Zero(u.size())));
  EXPECT_TRUE(model.status().ok());
}

TEST(Model, SaysWhichOperationItsKernelsLack) {
  auto table = ReferenceKernels<Tet4, 1, false>::table();
  VariantTable<double> variant = table.variants[0];
  variant.energy = nullptr;
  variant.apply = nullptr;
  table.variants = &variant;
  const Mesh mesh = bar_mesh("tet4", {1, 1, 1}, {1, 1, 1});
  Model model(mesh, one_part(mesh, table), {.threads = 1});
  const Vector u = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  try {
    static_cast<void>(model.energy(u));
    FAIL() << "no error";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("operation 'energy'"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(Model(mesh, one_part(mesh, table),
                     {.threads = 1, .tangent_product = TangentProduct::two_stage}),
               InternalError);
  EXPECT_THROW(static_cast<void>(model.energy(Vector::Zero(3))), InternalError);
}

}  // namespace
}  // namespace elastogen::test
