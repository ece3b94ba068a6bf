// One element's operations by walking graphs, on any arithmetic; exactly, again and again.
#pragma once

#include <cln/cln.h>

#include <memory>
#include <string>
#include <vector>

#include "symgen/dag/evaluate.h"
#include "symgen/pipeline.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// Inputs of one element's graph, in the order of ElementCase.
struct ElementInputs {
  std::vector<NodeId> positions, parameters, displacement, direction;
};

/// Names of a graph's inputs, by which they are found in graphs that are made from it.
class InputNames {
 public:
  explicit InputNames(const ElementGraph& graph);
  [[nodiscard]] ElementInputs in(Dag& dag) const;

 private:
  std::vector<std::string> positions_, parameters_, displacement_, direction_;
};

/// Results of one element; indices as in Evaluation.
template <class Number>
struct ElementResults {
  Number energy;
  std::vector<Number> forces, product;  ///< product empty without a direction
  std::vector<Number> stiffness;        ///< empty unless asked for
  bool inside_domain = true;            ///< all margins of the law's domain are positive
};

/// @param from_double  of the arithmetic
/// @throws OutsideDomain  from exact arithmetic
template <class Arithmetic, class FromDouble>
[[nodiscard]] ElementResults<typename Arithmetic::Number> evaluate_element(
    const VariantKernels& kernels, const ElementInputs& inputs, const ElementCase& values,
    const Arithmetic& arithmetic, const FromDouble& from_double, bool with_stiffness) {
  using Number = typename Arithmetic::Number;
  std::vector<Number> value_of(kernels.dag.size());
  const auto set = [&](const std::vector<NodeId>& nodes, const std::vector<double>& numbers) {
    for (std::size_t i = 0; i < nodes.size(); ++i) value_of[nodes[i]] = from_double(numbers[i]);
  };
  set(inputs.positions, values.rest_positions);
  set(inputs.parameters, values.parameters);
  set(inputs.displacement, values.displacement);
  const auto add_up = [&](const std::string& name) {
    const OperationKernels& operation = kernels.operation(name);
    std::vector<NodeId> roots;
    std::vector<int> outputs;
    for (const Piece& piece : operation.pieces) {
      roots.insert(roots.end(), piece.roots.begin(), piece.roots.end());
      outputs.insert(outputs.end(), piece.outputs.begin(), piece.outputs.end());
    }
    const std::vector<Number> values_of_roots = evaluate<Arithmetic>(
        kernels.dag, roots, arithmetic, [&](NodeId id) { return value_of[id]; });
    std::vector<Number> total(operation.num_outputs, from_double(0.0));
    for (std::size_t k = 0; k < roots.size(); ++k) {
      total[outputs[k]] = arithmetic.add(total[outputs[k]], values_of_roots[k]);
    }
    return total;
  };
  ElementResults<Number> result;
  result.energy = add_up("energy")[0];
  result.forces = add_up("forces");
  if (!values.direction.empty()) {
    set(inputs.direction, values.direction);
    result.product = add_up("product");
  }
  const std::size_t num_dofs = with_stiffness ? inputs.direction.size() : 0;
  result.stiffness.resize(num_dofs * num_dofs);
  for (std::size_t j = 0; j < num_dofs; ++j) {
    std::vector<double> unit(num_dofs, 0.0);
    unit[j] = 1.0;
    set(inputs.direction, unit);
    const std::vector<Number> column = add_up("product");
    for (std::size_t i = 0; i < num_dofs; ++i) {
      result.stiffness[i * num_dofs + j] = arithmetic.multiply(from_double(-1.0), column[i]);
    }
  }
  for (const Piece& piece : kernels.operation("energy").pieces) {
    for (const Number& margin : evaluate<Arithmetic>(kernels.dag, piece.margins, arithmetic,
                                                     [&](NodeId id) { return value_of[id]; })) {
      if (!(margin > from_double(0.0))) result.inside_domain = false;
    }
  }
  return result;
}

/// The exact element of an association: the textbook form of its law, before all passes, walked in
/// CLN numbers. Made once, evaluated for many inputs.
class ExactElement {
 public:
  ExactElement(const AssociationId& id, const Law& law, Derivation derivation);
  ~ExactElement();
  ExactElement(ExactElement&&) noexcept;
  ExactElement& operator=(ExactElement&&) noexcept;

  /// @param digits  decimal; the textbook form loses twice those of the strain
  /// @throws OutsideDomain  where the law is not defined
  /// @throws InputError     inputs that are not finite
  [[nodiscard]] ElementResults<cln::cl_R> evaluate(const ElementCase& input, unsigned digits,
                                                   bool with_stiffness) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elastogen::symgen
