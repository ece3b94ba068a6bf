// Calls one kernel once, inside `counted`, for a program that counts instructions.
// usage: count_kernel ASSOCIATION GEOMETRY forces|product kernel|pass
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "generated/hooke_hexa8_q8_none_tables.h"
#include "generated/hooke_tet4_q1_none_tables.h"
#include "generated/stvk_hexa8_q8_none_tables.h"
#include "generated/stvk_tet4_q1_none_tables.h"
#include "runtime/aligned_vector.h"

namespace {

using elastogen::AlignedVector;
using Table = elastogen::KernelTable<double>;
using Variant = elastogen::VariantTable<double>;

constexpr std::size_t batches_of_pass = 64;

const Table* find_table(const std::string& association) {
  for (const Table* table : {elastogen_kernels_hooke_tet4_q1_none_f64_simd(),
                             elastogen_kernels_hooke_hexa8_q8_none_f64_simd(),
                             elastogen_kernels_stvk_tet4_q1_none_f64_simd(),
                             elastogen_kernels_stvk_hexa8_q8_none_f64_simd()}) {
    if (association == table->association) return table;
  }
  return nullptr;
}

const Variant* find_variant(const Table& table, const std::string& geometry) {
  for (int k = 0; k < table.num_variants; ++k) {
    if (geometry == table.variants[k].geometry) return &table.variants[k];
  }
  return nullptr;
}

/// Elements beside each other that share no nodes.
struct Batches {
  Batches(const Table& table, const Variant& variant)
      : dofs_per_batch(static_cast<std::size_t>(table.num_nodes * table.lanes)),
        constants_per_batch(static_cast<std::size_t>(variant.num_constants * table.lanes)),
        constants(batches_of_pass * constants_per_batch, 0.5),
        parameters(static_cast<std::size_t>(table.num_parameters), 1.0),
        displacement(batches_of_pass * dofs_per_batch * 3, 0.01),
        direction(displacement.size(), 0.02),
        output(displacement.size()),
        flags(static_cast<std::size_t>(table.lanes)) {
    for (std::size_t k = 0; k < batches_of_pass * dofs_per_batch; ++k) {
      dofs.push_back(static_cast<std::int32_t>(3 * k));
    }
  }

  [[nodiscard]] elastogen::KernelArguments<double> arguments() {
    elastogen::KernelArguments<double> result;
    result.parameters = parameters.data();
    result.constants = constants.data();
    result.displacement = displacement.data();
    result.direction = direction.data();
    result.output = output.data();
    result.status = flags.data();
    return result;
  }

  std::size_t dofs_per_batch, constants_per_batch;
  AlignedVector<double> constants;
  std::vector<double> parameters;
  AlignedVector<double> displacement, direction, output;
  std::vector<std::uint32_t> flags;
  std::vector<std::int32_t> dofs;
};

}  // namespace

extern "C" {
[[gnu::noinline]] void counted_kernel(elastogen::KernelFunction<double> kernel,
                                      const elastogen::KernelArguments<double>& arguments) {
  kernel(&arguments, 1);
}
[[gnu::noinline]] void counted_pass(const Table& table, const elastogen::NodalPass<double>& pass) {
  table.nodal_pass(pass);
}
}

int main(int argc, char** argv) {
  const Table* const table = argc == 5 ? find_table(argv[1]) : nullptr;
  const Variant* const variant = table != nullptr ? find_variant(*table, argv[2]) : nullptr;
  if (variant == nullptr) {
    std::fputs("usage: count_kernel ASSOCIATION GEOMETRY forces|product kernel|pass\n", stderr);
    return 2;
  }
  const bool is_product = std::strcmp(argv[3], "product") == 0;
  const auto kernel = is_product ? variant->product : variant->forces;
  Batches batches(*table, *variant);
  if (std::strcmp(argv[4], "kernel") == 0) {
    counted_kernel(kernel, batches.arguments());
    return 0;
  }
  elastogen::NodalPass<double> pass;
  pass.kernel = kernel;
  pass.batches_at_once = variant->batches_at_once;
  pass.arguments = batches.arguments();
  pass.constants_stride = batches.constants_per_batch;
  pass.dofs = batches.dofs.data();
  pass.end = batches_of_pass;
  pass.num_elements = batches_of_pass * static_cast<std::size_t>(table->lanes);
  pass.displacement = batches.displacement.data();
  pass.direction = is_product ? batches.direction.data() : nullptr;
  pass.sum = batches.output.data();
  counted_pass(*table, pass);
  return 0;
}
