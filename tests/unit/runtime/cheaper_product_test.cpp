// How products are computed where the model may choose.
#include <gtest/gtest.h>

#include "runtime/model.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

/// What a model of so many cubes chooses with kernels of these costs; 72 numbers of state each.
struct Choice {
  VariantTable<double> variant = ReferenceKernels<Hexa8, 8, true>::table().variants[0];
  int cells = 4;
  ModelOptions options = {.threads = 1, .tangent_product = TangentProduct::automatic};

  [[nodiscard]] TangentProduct made() const {
    auto table = ReferenceKernels<Hexa8, 8, true>::table();
    table.variants = &variant;
    const Mesh mesh = bar_mesh("hexa8", {cells, cells, cells}, {1, 1, 1});
    return Model(mesh, one_part(mesh, table), options).tangent_product();
  }
};

TEST(CheaperProduct, IsInTwoStagesWhereOperationsSavedOutweighTheState) {
  Choice choice;
  choice.variant.costs = {1000, 300, 900};
  EXPECT_EQ(choice.made(), TangentProduct::recompute);
  choice.variant.costs = {1000, 300, 600};
  EXPECT_EQ(choice.made(), TangentProduct::two_stage);
  // Few products do not pay for what the first stage takes.
  choice.variant.costs = {1000, 2000, 600};
  EXPECT_EQ(choice.made(), TangentProduct::two_stage);
  choice.options.products_per_tangent = 3;
  EXPECT_EQ(choice.made(), TangentProduct::recompute);
}

TEST(CheaperProduct, ReadsStateFromMemoryWhereItIsLargerThanTheCache) {
  Choice choice;
  choice.variant.costs = {1000, 300, 600};
  choice.cells = 32;  // 32,768 elements, 608 bytes each
  EXPECT_EQ(choice.made(), TangentProduct::recompute);
  choice.variant.costs = {2000, 300, 600};
  EXPECT_EQ(choice.made(), TangentProduct::two_stage);
}

TEST(CheaperProduct, IsWhatTheKernelsHave) {
  Choice choice;
  choice.variant.costs = {1000, 1, 1};
  choice.variant.apply = nullptr;
  EXPECT_EQ(choice.made(), TangentProduct::recompute);
  choice = {};
  choice.variant.costs = {1, 1000, 1000};
  choice.variant.product = nullptr;
  EXPECT_EQ(choice.made(), TangentProduct::two_stage);
}

TEST(CheaperProduct, DoesNotOverruleTheCaller) {
  Choice choice;
  choice.variant.costs = {1000, 1, 1};
  for (const auto asked :
       {TangentProduct::recompute, TangentProduct::two_stage, TangentProduct::assembled}) {
    choice.options.tangent_product = asked;
    EXPECT_EQ(choice.made(), asked);
  }
}

}  // namespace
}  // namespace elastogen::test
