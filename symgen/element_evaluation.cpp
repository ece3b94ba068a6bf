#include "symgen/element_evaluation.h"

#include <fmt/format.h>

#include <cmath>

#include "symgen/dag/decimal.h"
#include "symgen/formulation.h"
#include "symgen/passes/split.h"
#include "symgen/reference_kernels.h"

namespace elastogen::symgen {
namespace {

constexpr const char* outside_domain =
    "outside the law's domain: the argument of a logarithm or root is not positive";

/// Results as text, numbers by `text`.
template <class Number, class Text>
Evaluation in_text(const ElementResults<Number>& results, const Text& text) {
  const auto texts = [&](const std::vector<Number>& numbers) {
    std::vector<std::string> result;
    for (const Number& number : numbers) result.push_back(text(number));
    return result;
  };
  return {text(results.energy), texts(results.forces), texts(results.product),
          texts(results.stiffness), results.inside_domain ? "ok" : outside_domain};
}

Evaluation evaluate_in_double(const AssociationId& id, const Law& law, const ElementCase& input,
                              const GenerateOptions& options) {
  const Formulation formulation(id, law, options.stabilise, options.derivation);
  const Profile& profile = find_profile(options.profile);
  const Split split = choose_split(id, formulation, law, profile).split;
  const InputNames names(formulation.graph(law, Geometry::general));
  StageLog log;
  VariantKernels kernels = written_out(
      kernels_of(formulation, law, Geometry::general, split, profile, Grouping::minimum_cut, log));
  const ElementInputs inputs = names.in(kernels.dag);
  bool finite = true;
  Evaluation result = in_text(
      evaluate_element(
          kernels, inputs, input, DoubleArithmetic{}, [](double value) { return value; }, true),
      [&finite](double value) {
        finite = finite && std::isfinite(value);
        return fmt::format("{:.17g}", value);
      });
  if (!finite && result.status == "ok") result.status = "not finite: a result is NaN or infinite";
  return result;
}

}  // namespace

InputNames::InputNames(const ElementGraph& graph) {
  positions_ = names_of(graph.dag, graph.positions);
  parameters_ = names_of(graph.dag, graph.parameters);
  displacement_ = names_of(graph.dag, graph.displacement);
  direction_ = names_of(graph.dag, graph.direction);
}

ElementInputs InputNames::in(Dag& dag) const {
  const auto nodes = [&](const std::vector<std::string>& names, Stage stage) {
    std::vector<NodeId> result;
    for (const std::string& name : names) result.push_back(dag.symbol(name, stage));
    return result;
  };
  return {nodes(positions_, Stage::rest), nodes(parameters_, Stage::material),
          nodes(displacement_, Stage::state), nodes(direction_, Stage::direction)};
}

struct ExactElement::Data {
  VariantKernels kernels;
  ElementInputs inputs;
};

ExactElement::ExactElement(const AssociationId& id, const Law& law, Derivation derivation) {
  const Formulation formulation(id, law, false, derivation);
  ElementGraph graph = formulation.graph(law, Geometry::general);
  const InputNames names(graph);
  VariantKernels kernels = unoptimised_kernels(std::move(graph));
  const ElementInputs inputs = names.in(kernels.dag);
  data_ = std::make_unique<Data>(Data{std::move(kernels), inputs});
}

ExactElement::~ExactElement() = default;
ExactElement::ExactElement(ExactElement&&) noexcept = default;
ExactElement& ExactElement::operator=(ExactElement&&) noexcept = default;

ElementResults<cln::cl_R> ExactElement::evaluate(const ElementCase& input, unsigned digits,
                                                 bool with_stiffness) const {
  const ClnArithmetic arithmetic(digits);
  return evaluate_element(
      data_->kernels, data_->inputs, input, arithmetic,
      [&](double value) { return arithmetic.from_double(value); }, with_stiffness);
}

Evaluation evaluate_graph(const AssociationId& id, const Law& law, const ElementCase& input,
                          GraphScalar scalar, const GenerateOptions& options) {
  if (scalar == GraphScalar::dag_double) return evaluate_in_double(id, law, input, options);
  constexpr unsigned digits = 100;  // the textbook form loses some near rest
  constexpr int shown_digits = 40;
  const auto text = [](const cln::cl_R& value) { return decimal_text(value, shown_digits); };
  try {
    if (scalar == GraphScalar::cln) {
      const ExactElement element(id, law, options.derivation);
      return in_text(element.evaluate(input, digits, true), text);
    }
    const Formulation formulation(id, law, false, Derivation::dag);
    ElementGraph graph = formulation.graph(law, Geometry::general);
    const InputNames names(graph);
    VariantKernels kernels = expanded_kernels(std::move(graph));
    const ElementInputs inputs = names.in(kernels.dag);
    const ClnArithmetic arithmetic(digits);
    return in_text(evaluate_element(
                       kernels, inputs, input, arithmetic,
                       [&](double value) { return arithmetic.from_double(value); }, true),
                   text);
  } catch (const OutsideDomain& outside) {
    Evaluation result;
    result.status = outside.what();
    return result;
  }
}

}  // namespace elastogen::symgen
