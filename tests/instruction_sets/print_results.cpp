// Prints what the default kernels compute on small meshes, for each table a line
//   ASSOCIATION PRECISION INSTRUCTION_SET LANES COUNT
// and COUNT numbers: energy, forces, tangent product. A wrong environment is an error, exit
// status 2.
#include <cstdio>
#include <exception>

#include "generated/hooke_hexa8_q8_none_tables.h"
#include "generated/hooke_tet4_q1_none_tables.h"
#include "generated/stvk_hexa8_q8_none_tables.h"
#include "generated/stvk_tet4_q1_none_tables.h"
#include "tests/unit/runtime/test_meshes.h"

namespace {

using namespace elastogen;

template <class Scalar>
void print_header(const KernelTable<Scalar>& table, const char* precision, Eigen::Index count) {
  std::printf("%s %s %s %d %ld\n", table.association, precision, table.instruction_set, table.lanes,
              static_cast<long>(count));
}

Vector results_of(const Mesh& mesh, const std::vector<ModelPart>& parts, Precision precision) {
  ModelOptions options;
  options.threads = 1;
  options.precision = precision;
  Model model(mesh, parts, options);
  const Vector u = test::random_vector(model.num_dofs(), 0.02, 1);
  const Vector v = test::random_vector(model.num_dofs(), 1, 2);
  Vector forces = Vector::Zero(u.size()), product = Vector::Zero(u.size());
  model.forces(u, forces);
  model.linearize(u);
  model.product(v, 1, product);
  Vector all(1 + 2 * u.size());
  all << model.energy(u), forces, product;
  return all;
}

void print_results(const KernelTable<double>& in_double, const KernelTable<float>& in_single) {
  const std::array<double, 3> lengths = {1, 0.5, 0.75};
  Mesh mesh = test::bar_mesh(in_double.element, {3, 2, 3}, lengths);
  test::distort(mesh, lengths, 0.03, 3);
  std::vector<ModelPart> parts = test::one_part(mesh, in_double);
  parts[0].single_kernels = &in_single;
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    const Vector all = results_of(mesh, parts, precision);
    if (precision == Precision::double_precision) {
      print_header(in_double, "double", all.size());
    } else {
      print_header(in_single, "single", all.size());
    }
    for (const double value : all) std::printf("%.17g\n", value);
  }
}

}  // namespace

int main() try {
  print_results(*elastogen_kernels_hooke_tet4_q1_none_f64_simd(),
                *elastogen_kernels_hooke_tet4_q1_none_f32_simd());
  print_results(*elastogen_kernels_hooke_hexa8_q8_none_f64_simd(),
                *elastogen_kernels_hooke_hexa8_q8_none_f32_simd());
  print_results(*elastogen_kernels_stvk_tet4_q1_none_f64_simd(),
                *elastogen_kernels_stvk_tet4_q1_none_f32_simd());
  print_results(*elastogen_kernels_stvk_hexa8_q8_none_f64_simd(),
                *elastogen_kernels_stvk_hexa8_q8_none_f32_simd());
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
