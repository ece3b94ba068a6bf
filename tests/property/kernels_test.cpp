// Compiled kernels of every association: against exact evaluation, against each other (energy,
// forces, product, stiffness, stress), and against mechanics (rigid motions).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "element_samples.h"
#include "runtime/aligned_vector.h"
#include "selector/commands/evaluation.h"
#include "symgen/element/element.h"
#include "symgen/mechanics/energy.h"
#include "tested_kernels.h"

namespace elastogen::test {
namespace {

using selector::evaluate_kernels;
using selector::KernelEvaluation;
using symgen::AssociationId;
using symgen::ElementCase;
using symgen::Law;

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t k = 0; k < a.size(); ++k) result = std::max(result, std::abs(a[k] - b[k]));
  return result;
}

std::vector<double> numbers(const std::vector<std::string>& texts) {
  std::vector<double> result;
  for (const std::string& text : texts) result.push_back(std::stod(text));
  return result;
}

/// The exact values of a case, rounded to double once.
KernelEvaluation exact_values(const AssociationId& id, const Law& law, const ElementCase& input) {
  const symgen::Evaluation exact = symgen::evaluate_graph(id, law, input, symgen::GraphScalar::cln);
  EXPECT_EQ(exact.status, "ok");
  KernelEvaluation result;
  result.energy = std::stod(exact.energy);
  result.forces = numbers(exact.forces);
  result.product = numbers(exact.product);
  result.stiffness = numbers(exact.stiffness);
  result.stress = numbers(exact.stress);
  return result;
}

/// Numbers first ... first + count - 1 of each point, of what the operation `stress` gives.
std::vector<double> part_of(const std::vector<double>& stress, std::size_t first,
                            std::size_t count) {
  std::vector<double> part;
  for (std::size_t point = first; point < stress.size(); point += stress_numbers) {
    const auto begin = stress.begin() + static_cast<std::ptrdiff_t>(point);
    part.insert(part.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  }
  return part;
}
std::vector<double> gradients_of(const std::vector<double>& stress) {
  return part_of(stress, 0, 9);
}
std::vector<double> first_piola_of(const std::vector<double>& stress) {
  return part_of(stress, 9, 9);
}
std::vector<double> densities_of(const std::vector<double>& stress) {
  return part_of(stress, 18, 1);
}
std::vector<double> volumes_of(const std::vector<double>& stress) { return part_of(stress, 19, 1); }

/// No limit: for laws that are not written in a stable form, where digits are lost near rest.
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Errors in ulp of the scalar, each over the size that its rounding is relative to.
struct Errors {
  double energy, forces, product, stiffness;
  double gradient, stress, density, volume;  ///< of all points
};

Errors errors_of(const KernelEvaluation& found, const KernelEvaluation& exact,
                 const ElementCase& input, double ulp) {
  const double stiffness = largest(exact.stiffness);
  const auto of_points = [&](auto numbers_of) {
    const std::vector<double> expected = numbers_of(exact.stress);
    EXPECT_EQ(found.stress.size(), exact.stress.size());
    return distance(numbers_of(found.stress), expected) / largest(expected) / ulp;
  };
  return {std::abs(found.energy - exact.energy) / std::abs(exact.energy) / ulp,
          distance(found.forces, exact.forces) / largest(exact.forces) / ulp,
          distance(found.product, exact.product) / (stiffness * largest(input.direction)) / ulp,
          distance(found.stiffness, exact.stiffness) / stiffness / ulp,
          of_points(gradients_of),
          of_points(first_piola_of),
          of_points(densities_of),
          of_points(volumes_of)};
}

/// A case whose numbers are all floats, so that float kernels get the same input.
ElementCase rounded_to_float(ElementCase input) {
  for (auto* values :
       {&input.rest_positions, &input.displacement, &input.direction, &input.parameters}) {
    for (double& value : *values) value = static_cast<double>(static_cast<float>(value));
  }
  return input;
}

class Kernels : public ::testing::TestWithParam<std::string> {
 protected:
  AssociationId id = AssociationId::parse(GetParam());
  Law law = law_named(id.law);
  const KernelTable<double>& table = *kernels_of(GetParam()).double_table();

  /// Whether every term is written in a form that keeps its digits near rest.
  [[nodiscard]] bool is_stable() const {
    const std::vector<bool> stabilised = symgen::energy_density(law, table.dim, {}).stabilised;
    return std::all_of(stabilised.begin(), stabilised.end(), [](bool each) { return each; });
  }

  /// Nothing is lost: of a gradient and a volume a few roundings, of energies some tens.
  void expect_small(const Errors& errors, double strain) const {
    EXPECT_LT(errors.energy, is_stable() ? 200 : unlimited);
    EXPECT_LT(errors.forces, is_stable() || strain > 1e-2 ? 50 : unlimited);
    EXPECT_LT(errors.product, 50);
    EXPECT_LT(errors.stiffness, 50);
    EXPECT_LT(errors.gradient, 20);
    EXPECT_LT(errors.stress, is_stable() || strain > 1e-2 ? 50 : unlimited);
    EXPECT_LT(errors.density, is_stable() ? 200 : unlimited);
    EXPECT_LT(errors.volume, 20);
  }

  [[nodiscard]] ElementCase sample(double strain, std::uint32_t seed = 1) const {
    SampleOptions options;
    options.strain = strain;
    options.seed = seed;
    return sample_case(id, law, options);
  }
};

TEST_P(Kernels, AgreeWithExactEvaluationAtEveryStrain) {
  for (const double strain : {1e-12, 1e-6, 1e-3, 0.1}) {
    SCOPED_TRACE(strain);
    const ElementCase input = sample(strain);
    const KernelEvaluation exact = exact_values(id, law, input);
    const KernelEvaluation found = evaluate_kernels(table, "general", input);
    EXPECT_EQ(found.status, status_ok);
    expect_small(errors_of(found, exact, input, std::numeric_limits<double>::epsilon()), strain);
  }
}

class FloatKernels : public Kernels {};

TEST_P(FloatKernels, AgreeWithExactEvaluation) {
  const KernelTable<float>& float_table = *kernels_of(GetParam()).float_table();
  for (const double strain : {1e-5, 0.1}) {
    SCOPED_TRACE(strain);
    const ElementCase input = rounded_to_float(sample(strain, 2));
    const KernelEvaluation exact = exact_values(id, law, input);
    const KernelEvaluation found = evaluate_kernels(float_table, "general", input);
    EXPECT_EQ(found.status, status_ok);
    expect_small(errors_of(found, exact, input, std::numeric_limits<float>::epsilon()), strain);
  }
}

/// W(U + hV) = W - h f.V + O(h^2), f(U + hV) = f + h p + O(h^2): halving h quarters the remainder.
TEST_P(Kernels, TaylorRemaindersFallWithTheSecondOrder) {
  ElementCase input = sample(0.05, 3);
  const KernelEvaluation at = evaluate_kernels(table, "general", input);
  double work = 0;
  for (std::size_t k = 0; k < at.forces.size(); ++k) work += at.forces[k] * input.direction[k];
  std::vector<double> energy_remainders, force_remainders;
  const std::vector<double> start = input.displacement;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    for (std::size_t k = 0; k < start.size(); ++k) {
      input.displacement[k] = start[k] + h * input.direction[k];
    }
    const KernelEvaluation ahead = evaluate_kernels(table, "general", input);
    energy_remainders.push_back(std::abs(ahead.energy - at.energy + h * work));
    std::vector<double> linear = at.forces;
    for (std::size_t k = 0; k < linear.size(); ++k) linear[k] += h * at.product[k];
    force_remainders.push_back(distance(ahead.forces, linear));
  }
  const double force_rounding = 1e-12 * largest(at.forces);
  for (std::size_t k = 0; k + 1 < energy_remainders.size(); ++k) {
    EXPECT_NEAR(energy_remainders[k] / energy_remainders[k + 1], 4.0, 0.4);
    if (force_remainders[k] > force_rounding) {  // a linear law has none
      EXPECT_NEAR(force_remainders[k] / force_remainders[k + 1], 4.0, 0.4);
    } else {
      EXPECT_EQ(id.law, "hooke");
    }
  }
}

TEST_P(Kernels, StiffnessIsSymmetricAndMinusTheProduct) {
  const ElementCase input = sample(0.1, 4);
  const KernelEvaluation at = evaluate_kernels(table, "general", input);
  const std::size_t size = input.displacement.size();
  const double scale = largest(at.stiffness);
  std::vector<double> product(size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      EXPECT_NEAR(at.stiffness[i * size + j], at.stiffness[j * size + i], 1e-13 * scale);
      product[i] -= at.stiffness[i * size + j] * input.direction[j];
    }
  }
  EXPECT_LT(distance(product, at.product), 1e-13 * static_cast<double>(size) * scale);
}

/// f = -sum_g w_g det J P : dF/dU, with dF_ij/dU_ai = dLambda_a/dX_j from the table's own points.
TEST_P(Kernels, ForcesAreTheIntegralOfTheStress) {
  const ElementCase input = sample(0.1, 8);
  const KernelEvaluation at = evaluate_kernels(table, "general", input);
  const auto dim = static_cast<std::size_t>(table.dim);
  const auto num_nodes = static_cast<std::size_t>(table.num_nodes);
  ASSERT_EQ(table.points.num_points, table.num_points);
  std::vector<double> forces(at.forces.size(), 0.0), sizes(at.forces.size(), 0.0);
  for (std::size_t g = 0; g < static_cast<std::size_t>(table.num_points); ++g) {
    const double* in_reference = table.points.gradients + g * num_nodes * dim;
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
        gradients(in_reference, table.num_nodes, table.dim),
        positions(input.rest_positions.data(), table.num_nodes, table.dim);
    const Eigen::MatrixXd jacobian = positions.transpose() * gradients;
    const Eigen::MatrixXd in_space = gradients * jacobian.inverse();  // [a][j]
    const double* numbers = at.stress.data() + g * stress_numbers;
    EXPECT_NEAR(numbers[19], table.points.weights[g] * jacobian.determinant(), 1e-13);
    for (std::size_t a = 0; a < num_nodes; ++a) {
      for (std::size_t i = 0; i < dim; ++i) {
        for (std::size_t j = 0; j < dim; ++j) {
          const double term = numbers[19] * numbers[9 + i * 3 + j] *
                              in_space(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(j));
          forces[a * dim + i] -= term;
          sizes[a * dim + i] += std::abs(term);
        }
      }
    }
  }
  EXPECT_LT(distance(forces, at.forces), 1e-14 * largest(sizes));
}

/// Projections integrate with the table's points: partitions of unity that hold linear functions.
TEST_P(Kernels, TablesHoldShapeFunctionsAtPoints) {
  const symgen::Element& element = symgen::find_element(id.element);
  const auto dim = static_cast<std::size_t>(table.dim);
  const double whole =
      std::accumulate(table.points.weights, table.points.weights + table.points.num_points, 0.0);
  for (const ReferencePoints& points : {table.points, table.rich_points}) {
    double volume = 0;
    for (std::size_t g = 0; g < static_cast<std::size_t>(points.num_points); ++g) {
      volume += points.weights[g];
      double sum = 0;
      Eigen::MatrixXd identity = Eigen::MatrixXd::Zero(table.dim, table.dim);
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        const std::size_t at = g * element.nodes.size() + a;
        sum += points.shapes[at];
        for (std::size_t i = 0; i < dim; ++i) {
          const double node = GiNaC::ex_to<GiNaC::numeric>(element.nodes[a][i].evalf()).to_double();
          for (std::size_t k = 0; k < dim; ++k) {
            identity(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) +=
                node * points.gradients[at * dim + k];
          }
        }
      }
      EXPECT_NEAR(sum, 1, 1e-15 * static_cast<double>(element.nodes.size()));
      EXPECT_LT((identity - Eigen::MatrixXd::Identity(table.dim, table.dim)).norm(), 1e-14);
    }
    EXPECT_NEAR(volume, whole, 1e-14 * whole);
  }
}

TEST_P(Kernels, RigidMotionsAreForceFree) {
  ElementCase input = sample(0.1, 5);
  // Linear strain is not objective: Hooke's law sees translations only.
  make_rigid_motion(input, table.dim, id.law == "hooke" ? 0.0 : 1.2);
  const KernelEvaluation at = evaluate_kernels(table, "general", input);
  // Rounding of displacements of size 1 against elements of size 1 and moduli of about 1000 Pa.
  EXPECT_LT(largest(at.forces), 1e-14 * largest(at.stiffness) * 10);
  // Neo-Hooke subtracts terms of the rotation's size: exact up to rounding of moduli, not of
  // strains.
  EXPECT_NEAR(at.energy, 0.0, 1e-14 * largest(at.stiffness));
}

TEST_P(Kernels, TranslationsCostNoDigits) {
  ElementCase input = sample(1e-3, 6);
  // A shift by a power of two that keeps every nodal difference exact.
  for (double& value : input.displacement) value = std::round(value * 0x1p30) * 0x1p-30;
  const KernelEvaluation near = evaluate_kernels(table, "general", input);
  for (double& value : input.displacement) value += 0x1p20;
  const KernelEvaluation far = evaluate_kernels(table, "general", input);
  EXPECT_EQ(near.forces, far.forces);
  EXPECT_EQ(near.energy, far.energy);
}

TEST_P(Kernels, SpecialVariantsAgreeWithTheGeneralOne) {
  const symgen::Element& element = symgen::find_element(id.element);
  std::vector<std::pair<std::string, SampleOptions>> variants;
  if (element.has_affine) variants.push_back({"affine", {.straight = true}});
  if (element.has_box) variants.push_back({"box", {.box = true}});
  ASSERT_EQ(table.num_variants, 1 + static_cast<int>(variants.size()));
  for (const auto& [geometry, options] : variants) {
    SCOPED_TRACE(geometry);
    const ElementCase input = sample_case(id, law, options);
    const KernelEvaluation general = evaluate_kernels(table, "general", input);
    const KernelEvaluation special = evaluate_kernels(table, geometry, input);
    EXPECT_NEAR(special.energy, general.energy, 1e-13 * general.energy);
    EXPECT_LT(distance(special.forces, general.forces), 1e-13 * largest(general.forces));
    EXPECT_LT(distance(special.product, general.product), 1e-13 * largest(general.product));
    EXPECT_LT(distance(special.stiffness, general.stiffness), 1e-13 * largest(general.stiffness));
    for (const auto numbers_of : {gradients_of, first_piola_of, densities_of, volumes_of}) {
      const std::vector<double> expected = numbers_of(general.stress);
      EXPECT_LT(distance(numbers_of(special.stress), expected), 1e-13 * largest(expected));
    }
  }
}

TEST_P(Kernels, GiveBatchesAtOnceWhatEachGetsAlone) {
  const VariantTable<double>& variant = table.variants[0];
  const auto lanes = static_cast<std::size_t>(table.lanes);
  const auto dofs = static_cast<std::size_t>(table.num_nodes * table.dim);
  const auto size_of = [&](std::int32_t count) { return lanes * static_cast<std::size_t>(count); };
  struct Batch {
    AlignedVector<double> positions, displacement, direction, constants, state, output, stress;
    std::vector<std::uint32_t> status;
  };
  std::vector<double> parameters;
  std::array<Batch, most_batches_at_once> batches;
  std::array<KernelArguments<double>, most_batches_at_once> arguments;
  for (std::size_t k = 0; k < batches.size(); ++k) {
    Batch& batch = batches[k];
    for (std::size_t d = 0; d < dofs; ++d) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const ElementCase each = sample(0.1, static_cast<int>(20 + 10 * k + lane));
        parameters = each.parameters;
        batch.positions.push_back(each.rest_positions[d]);
        batch.displacement.push_back(each.displacement[d]);
        batch.direction.push_back(each.direction[d]);
      }
    }
    batch.constants.resize(size_of(variant.num_constants));
    batch.state.resize(size_of(variant.num_state));
    batch.output.resize(lanes * dofs);
    batch.stress.resize(size_of(stress_numbers * table.num_points));
    batch.status.assign(lanes, status_ok);
    arguments[k] = {batch.positions.data(),    parameters.data(),      batch.constants.data(),
                    batch.displacement.data(), batch.direction.data(), batch.state.data(),
                    batch.constants.data(),    batch.status.data()};
    variant.constants(&arguments[k], 1);
  }
  const auto results = [&](KernelFunction<double> kernel, AlignedVector<double> Batch::*output,
                           int at_once) {
    std::vector<AlignedVector<double>> found;
    for (std::size_t k = 0; k < batches.size(); ++k) {
      std::fill((batches[k].*output).begin(), (batches[k].*output).end(), -1.0);
      arguments[k].output = (batches[k].*output).data();
    }
    for (int k = 0; k < most_batches_at_once; k += at_once) {
      kernel(arguments.data() + k, std::min(at_once, most_batches_at_once - k));
    }
    for (const Batch& batch : batches) {
      found.push_back(batch.*output);
      EXPECT_EQ(batch.status, std::vector<std::uint32_t>(lanes, status_ok));
    }
    return found;
  };
  const auto expect_same = [&](const char* name, KernelFunction<double> kernel,
                               AlignedVector<double> Batch::*output) {
    SCOPED_TRACE(name);
    const auto alone = results(kernel, output, 1);
    for (const int at_once : {2, 3, most_batches_at_once}) {
      EXPECT_EQ(results(kernel, output, at_once), alone) << at_once;
    }
  };
  expect_same("energy", variant.energy, &Batch::output);
  expect_same("forces", variant.forces, &Batch::output);
  expect_same("product", variant.product, &Batch::output);
  expect_same("linearize", variant.linearize, &Batch::state);
  expect_same("apply", variant.apply, &Batch::output);
  expect_same("stress", variant.stress, &Batch::stress);
}

TEST_P(Kernels, StatusTellsBadResults) {
  ElementCase input = sample(0.1, 7);
  input.displacement[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(evaluate_kernels(table, "general", input).status & status_not_finite, 0U);
  if (id.law != "neo_hookean" && id.law != "linlog") return;
  // Mirror the element: det F = -1 everywhere, outside the domain of ln J.
  const auto dim = static_cast<std::size_t>(table.dim);
  for (std::size_t k = 0; k < input.displacement.size(); ++k) {
    input.displacement[k] = k % dim == 0 ? -2 * input.rest_positions[k] : 0.0;
  }
  EXPECT_NE(evaluate_kernels(table, "general", input).status & status_outside_domain, 0U);
}

/// Derivatives of a logarithm are finite where it is not: each operation reports by itself.
TEST(Status, EveryOperationReportsTheDomain) {
  const KernelTable<double>& table = *kernels_of("linlog-hexa8-q8-none").double_table();
  const VariantTable<double>& variant = table.variants[0];
  const AssociationId id = AssociationId::parse("linlog-hexa8-q8-none");
  const ElementCase sample = sample_case(id, law_named("linlog"), {});
  const std::size_t dofs = sample.rest_positions.size();
  const auto lanes = static_cast<std::size_t>(table.lanes);
  AlignedVector<double> positions, displacement, direction(dofs * lanes, 1.0);
  AlignedVector<double> constants(static_cast<std::size_t>(variant.num_constants) * lanes);
  AlignedVector<double> state(static_cast<std::size_t>(variant.num_state) * lanes);
  for (std::size_t k = 0; k < dofs; ++k) {
    positions.insert(positions.end(), lanes, sample.rest_positions[k]);
    displacement.insert(displacement.end(), lanes,
                        k % 3 == 0 ? -2 * sample.rest_positions[k] : 0.0);
  }
  AlignedVector<double> output(dofs * dofs * lanes);
  KernelArguments<double> arguments;
  arguments.positions = positions.data();
  arguments.parameters = sample.parameters.data();
  arguments.constants = constants.data();
  arguments.displacement = displacement.data();
  arguments.direction = direction.data();
  arguments.output = constants.data();
  variant.constants(&arguments, 1);
  const auto expect_outside = [&](KernelFunction<double> kernel, double* into) {
    std::vector<std::uint32_t> status(lanes, status_ok);
    arguments.status = status.data();
    arguments.output = into;
    kernel(&arguments, 1);
    for (const std::uint32_t bits : status) EXPECT_NE(bits & status_outside_domain, 0U);
  };
  for (const auto kernel :
       {variant.energy, variant.forces, variant.product, variant.stiffness, variant.stress}) {
    expect_outside(kernel, output.data());
  }
  expect_outside(variant.linearize, state.data());
}

/// Neo-Hooke of E = 1 MPa, nu = 0.3 stretched to 1.6 with free sides.
TEST(Stress, OfUniaxialTensionIsThatOfTheClosedForm) {
  const AssociationId id = AssociationId::parse("neo_hookean-hexa8-q8-none");
  const Law law = law_named(id.law);
  ElementCase input = sample_case(id, law, {});
  input.parameters = symgen::parameters_from_young_poisson(law, 1e6, 0.3);
  const double lambda = input.parameters[0], mu = input.parameters[1], stretch = 1.6;
  const auto lateral = [&](double side) {  // stress, rising
    return mu * (side - 1 / side) + lambda * std::log(stretch * side * side) / side;
  };
  double low = 0.5, high = 1;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (lateral(middle) < 0 ? low : high) = middle;
  }
  for (std::size_t k = 0; k < input.displacement.size(); ++k) {
    input.displacement[k] = ((k % 3 == 0 ? stretch : low) - 1) * input.rest_positions[k];
  }
  const KernelTable<double>& table = *kernels_of(id.text()).double_table();
  const std::vector<double> stress =
      first_piola_of(evaluate_kernels(table, "general", input).stress);
  for (std::size_t g = 0; g < 8; ++g) {
    EXPECT_NEAR(stress[g * 9], 436971.2, 0.05);
    for (std::size_t k = 1; k < 9; ++k) EXPECT_NEAR(stress[g * 9 + k], 0, 1e-8);
  }
}

/// Plane strain holds the body in the third direction: F_33 = 1, so P_33 = lambda tr E.
TEST(Stress, OfPlaneStrainHasItsComponentAcrossThePlane) {
  for (const char* text : {"stvk-quad4-q4-none", "hooke-tri3-exact-none"}) {
    const AssociationId id = AssociationId::parse(text);
    const Law law = law_named(id.law);
    const ElementCase input = sample_case(id, law, {});
    const std::vector<double> found =
        evaluate_kernels(*kernels_of(text).double_table(), "general", input).stress;
    for (std::size_t first = 0; first < found.size(); first += stress_numbers) {
      const double* h = found.data() + first;
      const double* stress = h + 9;
      for (const int zero : {2, 5, 6, 7, 8}) EXPECT_EQ(h[zero], 0) << text;
      for (const int zero : {2, 5, 6, 7}) EXPECT_EQ(stress[zero], 0) << text;
      const double square = h[0] * h[0] + h[1] * h[1] + h[3] * h[3] + h[4] * h[4];
      const double trace = h[0] + h[4] + (id.law == "stvk" ? square / 2 : 0);
      EXPECT_NEAR(stress[8], input.parameters[0] * trace, 1e-12 * input.parameters[0]) << text;
    }
  }
}

std::vector<std::string> all_tested() {
  std::vector<std::string> ids;
  for (const TestedKernels& each : tested_kernels()) ids.push_back(each.association);
  return ids;
}

std::vector<std::string> tested_in_float() {
  std::vector<std::string> ids;
  for (const TestedKernels& each : tested_kernels()) {
    if (each.float_table != nullptr) ids.push_back(each.association);
  }
  return ids;
}

INSTANTIATE_TEST_SUITE_P(All, Kernels, ::testing::ValuesIn(all_tested()),
                         [](const auto& info) { return test_name(info.param); });
INSTANTIATE_TEST_SUITE_P(All, FloatKernels, ::testing::ValuesIn(tested_in_float()),
                         [](const auto& info) { return test_name(info.param); });

#ifdef ELASTOGEN_CATALOGUE
TEST(TestedKernels, CoverEveryUnsplitAssociation) {
  for (const std::string& association : unsplit_associations()) {
    EXPECT_TRUE(is_tested(association)) << association;
  }
}
#endif

TEST(TestedKernels, CoverLawsElementsQuadraturesAndSplits) {
  std::set<std::string> laws_on_elements, quadratures, splits, letters;
  for (const std::string& association : all_tested()) {
    const AssociationId id = AssociationId::parse(association);
    laws_on_elements.insert(id.law + " " + id.element);
    quadratures.insert(id.element + " " + id.quadrature);
    splits.insert(id.split);
    if (id.split == "auto" || id.split == "none") continue;
    for (const char letter : id.split) letters.insert(id.element + " " + letter);
  }
  std::set<std::string> elements;
  for (const std::string& association : unsplit_associations()) {
    const AssociationId id = AssociationId::parse(association);
    EXPECT_TRUE(laws_on_elements.contains(id.law + " " + id.element)) << association;
    EXPECT_TRUE(quadratures.contains(id.element + " " + id.quadrature)) << association;
    elements.insert(id.element);
  }
  for (const std::string& split : symgen::split_names()) {
    EXPECT_TRUE(splits.contains(split)) << split;
  }
  for (const char letter : std::string("lgnd")) {
    const auto count = std::count_if(elements.begin(), elements.end(), [&](const std::string& e) {
      return letters.contains(e + " " + letter);
    });
    EXPECT_GE(count, 3) << letter << " on " << count << " elements";
  }
}

}  // namespace
}  // namespace elastogen::test
