#include "symgen/element_evaluation.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "symgen/dag/decimal.h"
#include "symgen/formulation.h"
#include "symgen/passes/split.h"
#include "symgen/reference_kernels.h"
#include "symgen/walk_kernels.h"

namespace elastogen::symgen {
namespace {

constexpr const char* outside_domain =
    "outside the law's domain: the argument of a logarithm or root is not positive";

/// Results as text, numbers by `text`.
template <class Arithmetic, class Text>
Evaluation in_text(const ElementResults<typename Arithmetic::Number>& results, const Law& law,
                   const Arithmetic& arithmetic, const Text& text) {
  using Number = typename Arithmetic::Number;
  const auto texts = [&](const std::vector<Number>& numbers) {
    std::vector<std::string> result;
    for (const Number& number : numbers) result.push_back(text(number));
    return result;
  };
  std::vector<std::vector<std::string>> cauchy;
  for (const std::vector<Number>& sigma :
       cauchy_stress(results.stress, law.small_strain, arithmetic)) {
    cauchy.push_back(texts(sigma));
  }
  return {text(results.energy),
          texts(results.forces),
          texts(results.product),
          texts(results.stiffness),
          texts(results.stress),
          std::move(cauchy),
          results.inside_domain ? "ok" : outside_domain};
}

/// What the C++ text computes, with constants stored and stiffness in two stages.
Evaluation evaluate_in_double(const AssociationId& id, const Law& law, const ElementCase& input,
                              const GenerateOptions& options) {
  const Formulation formulation(id, law, options.stabilise, options.derivation);
  const Profile& profile = find_profile(options.profile);
  const Split split = choose_split(id, formulation, law, profile).split;
  StageLog log;
  const VariantKernels kernels =
      kernels_of(formulation, law, Geometry::general, split, profile, options.grouping, log);
  KernelWalk<DoubleArithmetic> walk(kernels, {});
  KernelWalk<DoubleArithmetic>::Arrays arrays{input.rest_positions, input.parameters, {},
                                              input.displacement,   input.direction,  {}};
  arrays.constants = walk.run("constants", arrays);
  ElementResults<double> results;
  results.energy = walk.run("energy", arrays)[0];
  results.forces = walk.run("forces", arrays);
  if (!input.direction.empty()) results.product = walk.run("product", arrays);
  results.stiffness = walk.stiffness(arrays);
  results.stress = walk.run("stress", arrays);
  results.inside_domain = walk.inside_domain();
  bool finite = true;
  Evaluation result = in_text(results, law, DoubleArithmetic{}, [&finite](double value) {
    finite = finite && std::isfinite(value);
    return fmt::format("{:.17g}", value);
  });
  if (!finite && result.status == "ok") result.status = "not finite: a result is NaN or infinite";
  return result;
}

/// Walks the graphs.
ElementResults<cln::cl_R> evaluate_exactly(const ReferenceKernels& kernels,
                                           const ElementCase& input,
                                           const ClnArithmetic& arithmetic, bool with_stiffness) {
  std::vector<cln::cl_R> value_of(kernels.dag.size());
  const auto set = [&](const std::vector<NodeId>& nodes, const std::vector<double>& numbers) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      value_of[nodes[i]] = arithmetic.from_double(numbers[i]);
    }
  };
  const auto values = [&](const std::vector<NodeId>& roots) {
    return evaluate<ClnArithmetic>(kernels.dag, roots, arithmetic,
                                   [&](NodeId id) { return value_of[id]; });
  };
  set(kernels.positions, input.rest_positions);
  set(kernels.parameters, input.parameters);
  set(kernels.displacement, input.displacement);
  ElementResults<cln::cl_R> results;
  results.energy = values({kernels.energy})[0];
  results.forces = values(kernels.forces);
  results.stress = values(kernels.stress);
  if (!input.direction.empty()) {
    set(kernels.direction, input.direction);
    results.product = values(kernels.product);
  }
  const std::size_t num_dofs = with_stiffness ? kernels.direction.size() : 0;
  results.stiffness.resize(num_dofs * num_dofs);
  for (std::size_t j = 0; j < num_dofs; ++j) {
    std::vector<double> unit(num_dofs, 0.0);
    unit[j] = 1.0;
    set(kernels.direction, unit);
    const std::vector<cln::cl_R> column = values(kernels.product);
    for (std::size_t i = 0; i < num_dofs; ++i) results.stiffness[i * num_dofs + j] = -column[i];
  }
  return results;
}

}  // namespace

struct ExactElement::Data {
  ReferenceKernels kernels;
};

ExactElement::ExactElement(const AssociationId& id, const Law& law, Derivation derivation) {
  const Formulation formulation(id, law, false, derivation);
  ElementGraph graph = formulation.graph(law, Geometry::general);
  const StressGraph stress =
      formulation.stress_graph(law, Geometry::general, graph.dag.number_pool());
  data_ = std::make_unique<Data>(Data{unoptimised_kernels(std::move(graph), stress)});
}

ExactElement::~ExactElement() = default;
ExactElement::ExactElement(ExactElement&&) noexcept = default;
ExactElement& ExactElement::operator=(ExactElement&&) noexcept = default;

ElementResults<cln::cl_R> ExactElement::evaluate(const ElementCase& input, unsigned digits,
                                                 bool with_stiffness) const {
  return evaluate_exactly(data_->kernels, input, ClnArithmetic(digits), with_stiffness);
}

Evaluation evaluate_graph(const AssociationId& id, const Law& law, const ElementCase& input,
                          GraphScalar scalar, const GenerateOptions& options) {
  if (scalar == GraphScalar::dag_double) return evaluate_in_double(id, law, input, options);
  constexpr unsigned digits = 100;  // the textbook form loses some near rest
  constexpr int shown_digits = 40;
  const ClnArithmetic arithmetic(digits);
  const auto text = [](const cln::cl_R& value) { return decimal_text(value, shown_digits); };
  try {
    if (scalar == GraphScalar::cln) {
      const ExactElement element(id, law, options.derivation);
      return in_text(element.evaluate(input, digits, true), law, arithmetic, text);
    }
    const Formulation formulation(id, law, false, Derivation::dag);
    const ReferenceKernels kernels = expanded_kernels(formulation.graph(law, Geometry::general));
    return in_text(evaluate_exactly(kernels, input, arithmetic, true), law, arithmetic, text);
  } catch (const OutsideDomain& outside) {
    Evaluation result;
    result.status = outside.what();
    return result;
  }
}

}  // namespace elastogen::symgen
