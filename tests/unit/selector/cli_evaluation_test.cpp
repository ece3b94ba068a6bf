#include <gtest/gtest.h>

#include <limits>

#include "runtime/error.h"
#include "selector/commands/evaluation.h"
#include "temporary_folder.h"
#include "tests/unit/each_batch.h"

namespace elastogen::selector {
namespace {

using test::each_batch;

// Kernels of springs from each degree of freedom to its rest position: W = 1/2 p u.u with the
// grouped constant p = parameter * first coordinate. One lane of `broken` tables is off.
constexpr int num_dofs = 12;
bool break_last_lane = false;

template <int Lanes>
void constants(const KernelArguments<double>& a) {
  for (int l = 0; l < Lanes; ++l) a.output[l] = a.parameters[0] * a.positions[l];
}

template <int Lanes>
void energy(const KernelArguments<double>& a) {
  for (int l = 0; l < Lanes; ++l) {
    a.output[l] = 0;
    for (int k = 0; k < num_dofs; ++k) {
      const double u = a.displacement[k * Lanes + l];
      a.output[l] += 0.5 * a.constants[l] * u * u;
    }
    if (!(a.output[l] < std::numeric_limits<double>::infinity())) a.status[l] |= status_not_finite;
  }
  if (break_last_lane) a.output[Lanes - 1] += 1;
}

template <int Lanes>
void forces(const KernelArguments<double>& a) {
  for (int k = 0; k < num_dofs * Lanes; ++k) {
    a.output[k] = -a.constants[k % Lanes] * a.displacement[k];
  }
}

template <int Lanes>
void product(const KernelArguments<double>& a) {
  for (int k = 0; k < num_dofs * Lanes; ++k) {
    a.output[k] = -a.constants[k % Lanes] * a.direction[k];
  }
}

template <int Lanes>
void stiffness(const KernelArguments<double>& a) {
  for (int k = 0; k < num_dofs * num_dofs * Lanes; ++k) {
    a.output[k] = (k / Lanes) % (num_dofs + 1) == 0 ? a.constants[k % Lanes] : 0;
  }
}

template <int Lanes>
void stress(const KernelArguments<double>& a) {
  for (int k = 0; k < stress_numbers * Lanes; ++k) a.output[k] = k / Lanes;
}

template <int Lanes>
const KernelTable<double>& spring_table() {
  static const char* const names[] = {"p"};
  static const VariantTable<double> variants[] = {{"general",
                                                   1,
                                                   0,
                                                   false,
                                                   1,
                                                   {1, 1, 1},
                                                   each_batch<constants<Lanes>>,
                                                   nullptr,
                                                   each_batch<energy<Lanes>>,
                                                   each_batch<forces<Lanes>>,
                                                   each_batch<product<Lanes>>,
                                                   nullptr,
                                                   nullptr,
                                                   each_batch<stiffness<Lanes>>,
                                                   each_batch<stress<Lanes>>}};
  static const KernelTable<double> table = {kernel_abi_version,
                                            Lanes,
                                            "spring-tet4-q1-none",
                                            "tet4",
                                            "",
                                            "native",
                                            3,
                                            4,
                                            1,
                                            1,
                                            names,
                                            nullptr,
                                            1,
                                            variants,
                                            {},
                                            {}};
  return table;
}

symgen::ElementCase spring_case() {
  symgen::ElementCase input;
  input.rest_positions.assign(num_dofs, 2.0);
  input.parameters = {5.0};
  input.displacement.assign(num_dofs, 0.0);
  input.displacement[4] = 0.5;
  input.direction.assign(num_dofs, 0.0);
  input.direction[7] = 3.0;
  return input;
}

template <int Lanes>
void expect_spring_results() {
  const KernelEvaluation result = evaluate_kernels(spring_table<Lanes>(), "general", spring_case());
  EXPECT_EQ(result.energy, 0.5 * 10 * 0.25);
  EXPECT_EQ(result.forces[4], -5.0);
  EXPECT_EQ(result.product[7], -30.0);
  ASSERT_EQ(result.stiffness.size(), 144U);
  EXPECT_EQ(result.stiffness[3 * 12 + 3], 10.0);
  EXPECT_EQ(result.stiffness[3 * 12 + 4], 0.0);
  ASSERT_EQ(result.stress.size(), static_cast<std::size_t>(stress_numbers));
  EXPECT_EQ(result.stress[19], 19.0);
  EXPECT_EQ(status_text(result.status), "ok");
}

TEST(EvaluateKernels, CallsAScalarTable) { expect_spring_results<1>(); }
TEST(EvaluateKernels, CallsAPackTable) { expect_spring_results<most_lanes<double>>(); }

TEST(EvaluateKernels, FindsALaneThatDisagrees) {
  break_last_lane = true;
  EXPECT_THROW((void)evaluate_kernels(spring_table<most_lanes<double>>(), "general", spring_case()),
               InternalError);
  break_last_lane = false;
}

TEST(EvaluateKernels, PassesOnTheStatus) {
  symgen::ElementCase input = spring_case();
  input.displacement[0] = std::numeric_limits<double>::infinity();
  const KernelEvaluation result = evaluate_kernels(spring_table<1>(), "general", input);
  EXPECT_EQ(result.status, status_not_finite);
  EXPECT_NE(status_text(result.status), "ok");
}

TEST(EvaluateKernels, HasNoProductWithoutADirection) {
  symgen::ElementCase input = spring_case();
  input.direction.clear();
  EXPECT_TRUE(evaluate_kernels(spring_table<1>(), "general", input).product.empty());
}

TEST(EvaluateKernels, NamesTheVariantsThatExist) {
  const std::string message = message_of<InputError>(
      [] { (void)evaluate_kernels(spring_table<1>(), "box", spring_case()); });
  EXPECT_NE(message.find("'box' (it has: general)"), std::string::npos) << message;
}

}  // namespace
}  // namespace elastogen::selector
