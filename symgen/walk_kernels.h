// What is emitted, walked with any arithmetic: the oracle of everything before the printers.
#pragma once

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "symgen/dag/evaluate.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// Walks the kernels of one geometry variant statement by statement, as the generated C++ does:
/// operations in steps where they have them, equal fragments by one shape and its rows, loops over
/// points. Constants are stored, with what they have absorbed, and read again.
template <class Arithmetic>
class KernelWalk {
 public:
  using Number = typename Arithmetic::Number;

  /// Arrays of one element, indices as in runtime/kernel_abi.h.
  struct Arrays {
    std::vector<Number> positions, parameters, constants, displacement, direction, state;
  };

  KernelWalk(const VariantKernels& kernels, Arithmetic arithmetic)
      : kernels_(kernels),
        arithmetic_(std::move(arithmetic)),
        zero_(arithmetic_.from_exact(ExactNumber(0))) {}

  /// What an operation of the element computes; arrays that it does not read may be empty.
  [[nodiscard]] std::vector<Number> run(const std::string& name, const Arrays& arrays) {
    const OperationKernels& operation = kernels_.operation(name);
    std::vector<Number> result(static_cast<std::size_t>(kernels_.num_outputs(operation)), zero_);
    const Inputs in{arrays.positions.data(),
                    arrays.parameters.data(),
                    arrays.constants.data(),
                    arrays.state.data(),
                    arrays.displacement.data(),
                    arrays.direction.data(),
                    nullptr};
    if (kernels_.loop && name != "geometry") {
      run_loop(operation, in, result.data());
    } else {
      run_kernel(operation, in, result.data());
    }
    return result;
  }

  /// K = -apply along every unit direction, of the state that linearize gives.
  [[nodiscard]] std::vector<Number> stiffness(Arrays arrays) {
    arrays.state = run("linearize", arrays);
    const std::size_t size = arrays.displacement.size();
    const Number one = arithmetic_.from_exact(ExactNumber(1));
    const Number minus_one = arithmetic_.from_exact(ExactNumber(-1));
    std::vector<Number> result(size * size, zero_);
    arrays.direction.assign(size, zero_);
    for (std::size_t j = 0; j < size; ++j) {
      arrays.direction[j] = one;
      const std::vector<Number> column = run("apply", arrays);
      arrays.direction[j] = zero_;
      for (std::size_t i = 0; i < size; ++i) {
        result[i * size + j] = arithmetic_.multiply(minus_one, column[i]);
      }
    }
    return result;
  }

  /// Whether all margins of the law's domain were positive so far.
  [[nodiscard]] bool inside_domain() const { return inside_domain_; }

 private:
  struct Inputs {
    const Number *x, *p, *c, *s, *u, *v, *w;
  };
  struct Row {
    const std::vector<NumberId>& numbers;
    const std::vector<int>& indices;
  };

  /// The operation, or one point of it: assigns its outputs.
  void run_kernel(const OperationKernels& operation, Inputs in, Number* out) {
    std::fill(out, out + operation.num_outputs, zero_);
    if (operation.steps) {
      const Steps& steps = *operation.steps;
      std::vector<Number> carried(static_cast<std::size_t>(steps.num_carried), zero_);
      in.w = carried.data();
      run_fragment(steps.arguments, nullptr, in, carried.data());
      run_fragment(steps.functions, nullptr, in, carried.data());
      run_fragment(steps.rest, nullptr, in, out);
    } else if (operation.fragments.size() == 1) {
      run_fragment(operation.fragments[0], nullptr, in, out);
    } else {
      for (const FragmentGroup& group : groups_of(operation)) {
        for (std::size_t m = 0; m < group.num_members(); ++m) {
          const Row row{group.numbers[m], group.indices[m]};
          run_fragment(group.shape, &row, in, out);
        }
      }
    }
  }

  void run_loop(const OperationKernels& operation, const Inputs& in, Number* out) {
    const PointLoop& loop = *kernels_.loop;
    const std::string& name = operation.name;
    const bool is_once = name == "constants" && loop.is_affine;
    const bool is_summed = is_nodal(name) || name == "energy";
    const auto interpolated = [&](const Number* field) {
      Inputs of_field = in;
      of_field.u = field;
      return mapped(loop.interpolate, of_field);
    };
    std::vector<Number> x, u, v;
    if (reads(operation, Slot::position)) {
      x = loop.is_affine ? mapped(loop.jacobian, in) : interpolated(in.x);
    }
    if (reads(operation, Slot::displacement)) u = interpolated(in.u);
    if (reads_weights(name)) {
      v = mapped(loop.point_weights, in);
    } else if (reads(operation, Slot::direction)) {
      v = interpolated(in.v);
    }
    const int num_points = is_once ? 1 : kernels_.num_points;
    const int entries = kernels_.dim * kernels_.dim;
    const int num_constants = static_cast<int>(kernels_.constants.size());
    std::vector<Number> at_points(static_cast<std::size_t>(num_points * operation.num_outputs));
    for (int g = 0; g < num_points; ++g) {
      const Inputs at{x.data() + (loop.is_affine ? 0 : g * entries),
                      in.p,
                      in.c + (loop.is_affine || name == "constants" ? 0 : g * num_constants),
                      in.s + (name == "apply" ? g * kernels_.num_state : 0),
                      u.data() + g * entries,
                      v.data() + g * (reads_weights(name) ? 1 : entries),
                      nullptr};
      run_kernel(operation, at, at_points.data() + g * operation.num_outputs);
    }
    if (!is_summed) {
      std::copy(at_points.begin(), at_points.end(), out);
      return;
    }
    Inputs of_points = in;
    of_points.u = at_points.data();
    run_kernel(is_nodal(name) ? loop.integrate : loop.weigh, of_points, out);
  }

  std::vector<Number> mapped(const OperationKernels& map, const Inputs& in) {
    std::vector<Number> result(static_cast<std::size_t>(map.num_outputs), zero_);
    run_kernel(map, in, result.data());
    return result;
  }

  /// Adds to outputs.
  void run_fragment(const Fragment& fragment, const Row* row, const Inputs& in, Number* out) {
    std::vector<Number> temporaries;
    temporaries.reserve(fragment.statements.size());
    const auto number = [&](const Literal& literal) -> const Number& {
      return exact(literal.entry >= 0 ? row->numbers[literal.entry] : literal.value);
    };
    const auto value = [&](const Reference& reference) -> Number {
      const int index = reference.entry >= 0 ? row->indices[reference.entry] : reference.index;
      switch (reference.slot) {
        case Slot::number:
          return exact(static_cast<NumberId>(index));
        case Slot::position:
          return in.x[index];
        case Slot::parameter:
          return in.p[index];
        case Slot::constant:
          return in.c[index];
        case Slot::displacement:
          return in.u[index];
        case Slot::direction:
          return in.v[index];
        case Slot::state:
          return in.s[index];
        case Slot::carried:
          return in.w[index];
        case Slot::temporary:
          return temporaries[static_cast<std::size_t>(index)];
      }
      throw InternalError("a statement reads from an unknown slot");
    };
    for (const Statement& statement : fragment.statements) {
      temporaries.push_back(computed(statement, number, value));
    }
    for (const Output& output : fragment.outputs) {
      Number result = arithmetic_.multiply(number(output.size), value(output.value));
      if (output.negative) result = negated(result);
      const int index = output.entry >= 0 ? row->indices[output.entry] : output.index;
      if (index == Output::margin) {
        if (!(result > zero_)) inside_domain_ = false;
      } else {
        out[index] = arithmetic_.add(out[index], result);
      }
    }
  }

  template <class NumberOf, class ValueOf>
  Number computed(const Statement& statement, const NumberOf& number, const ValueOf& value) {
    if (statement.kind == Kind::function) {
      return arithmetic_.apply(statement.function, value(statement.factors[0].value));
    }
    if (statement.kind == Kind::product) {
      Number product = arithmetic_.from_exact(ExactNumber(1));
      for (const auto& [factor, exponent] : statement.factors) {
        const cln::cl_RA power = cln::cl_I(exponent.numerator) / cln::cl_I(exponent.denominator);
        product = arithmetic_.multiply(
            product, power == 1 ? value(factor) : arithmetic_.power(value(factor), power));
      }
      return product;
    }
    Number total = number(statement.constant);
    for (const TermGroup& group : statement.groups) {
      Number sum = zero_;
      for (const TermGroup::Term& term : group.terms) {
        sum = arithmetic_.add(sum, term.negative ? negated(value(term.value)) : value(term.value));
      }
      total = arithmetic_.add(total, arithmetic_.multiply(number(group.size), sum));
    }
    return total;
  }

  const std::vector<FragmentGroup>& groups_of(const OperationKernels& operation) {
    const auto [groups, is_new] = groups_.try_emplace(&operation);
    if (is_new) groups->second = group_fragments(operation.fragments);
    return groups->second;
  }

  [[nodiscard]] const Number& exact(NumberId id) {
    const auto [number, is_new] = numbers_.try_emplace(id, zero_);
    if (is_new) number->second = arithmetic_.from_exact(kernels_.dag.numbers().exact(id));
    return number->second;
  }
  [[nodiscard]] Number negated(const Number& value) const {
    return arithmetic_.multiply(arithmetic_.from_exact(ExactNumber(-1)), value);
  }

  const VariantKernels& kernels_;
  Arithmetic arithmetic_;
  Number zero_;
  std::unordered_map<NumberId, Number> numbers_;
  std::unordered_map<const OperationKernels*, std::vector<FragmentGroup>> groups_;
  bool inside_domain_ = true;
};

}  // namespace elastogen::symgen
