#include "symgen/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>

#include "runtime/error.h"
#include "runtime/kernel_abi.h"
#include "symgen/build_kernels.h"
#include "symgen/dag/decimal.h"
#include "symgen/dag/dot.h"
#include "symgen/dag/evaluate.h"
#include "symgen/emit/content_hash.h"
#include "symgen/emit/print_cpp.h"
#include "symgen/emit/print_opencl.h"
#include "symgen/version.h"

namespace elastogen::symgen {
namespace {

/// The split of an association; for `auto`, the coarsest whose fragments stay below the profile's
/// limit (fewest fragments first).
struct ChosenSplit {
  Split split;
  std::string reason;
};

ChosenSplit choose_split(const AssociationId& id, const ElementGraph& graph, const Element& element,
                         const Profile& profile) {
  if (id.split != "auto") return {Split::parse(id.split), "asked for"};
  const int num_terms = static_cast<int>(graph.energies.size());
  const int num_points = static_cast<int>(graph.energies[0].size());
  const auto num_fragments = [&](const Split& split) {
    return energy_parts(split, num_terms, num_points).size() *
           row_parts(split, element.num_nodes(), element.dim).size();
  };
  std::vector<Split> splits = all_splits();
  std::stable_sort(splits.begin(), splits.end(), [&](const Split& a, const Split& b) {
    return num_fragments(a) < num_fragments(b);
  });
  for (const Split& split : splits) {
    const long largest = typical_fragment_flops(graph, split);
    if (largest <= profile.fragment_flops) {
      return {split, fmt::format("coarsest split whose fragments stay below {} flops (profile {}): "
                                 "the largest has {}",
                                 profile.fragment_flops, profile.name, largest)};
    }
  }
  return {splits.back(),
          fmt::format("finest split; even its fragments exceed {} flops (profile {})",
                      profile.fragment_flops, profile.name)};
}

/// Distinct indices that an operation's fragments read from one input array.
std::size_t numbers_read(const OperationKernels& operation, Slot slot) {
  std::set<int> read;
  const auto see = [&](const Reference& value) {
    if (value.slot == slot) read.insert(value.index);
  };
  for (const Fragment& fragment : operation.fragments) {
    for (const Statement& statement : fragment.statements) {
      for (const Factor& factor : statement.factors) see(factor.value);
      for (const TermGroup& group : statement.groups) {
        for (const TermGroup::Term& term : group.terms) see(term.value);
      }
    }
    for (const Output& output : fragment.outputs) see(output.value);
  }
  return read.size();
}

OperationReport report_of(const OperationKernels& operation) {
  OperationReport report;
  report.name = operation.name;
  for (const Fragment& fragment : operation.fragments) {
    report.flops += fragment.operations.flops();
  }
  report.fragments = static_cast<int>(operation.fragments.size());
  report.constants = static_cast<int>(operation.name == "constants"
                                          ? static_cast<std::size_t>(operation.num_outputs)
                                          : numbers_read(operation, Slot::constant));
  report.state = static_cast<int>(operation.name == "linearize"
                                      ? static_cast<std::size_t>(operation.num_outputs)
                                      : numbers_read(operation, Slot::state));
  for (const Slot slot :
       {Slot::position, Slot::constant, Slot::displacement, Slot::direction, Slot::state}) {
    report.bytes_read += static_cast<long>(sizeof(double) * numbers_read(operation, slot));
  }
  report.bytes_written = static_cast<long>(sizeof(double)) * operation.num_outputs;
  return report;
}

VariantReport report_of(const VariantKernels& kernels) {
  VariantReport report;
  report.geometry = geometry_name(kernels.geometry);
  report.num_constants = static_cast<int>(kernels.constants.size());
  report.num_state = kernels.num_state;
  report.reads_positions = kernels.reads_positions;
  report.constants_algorithm6 = kernels.constants_algorithm6;
  for (const OperationKernels& operation : kernels.operations) {
    report.operations.push_back(report_of(operation));
  }
  const OperationReport linearize = report_of(kernels.operation("linearize"));
  const OperationReport apply = report_of(kernels.operation("apply"));
  const int num_dofs = kernels.num_nodes * kernels.dim;
  OperationReport stiffness = linearize;
  stiffness.name = "stiffness";
  stiffness.flops = linearize.flops + num_dofs * apply.flops;
  stiffness.bytes_written = static_cast<long>(sizeof(double)) * num_dofs * num_dofs;
  report.operations.push_back(stiffness);
  return report;
}

/// Law, element and quadrature of an association, as one graph per geometry variant.
struct Formulation {
  Formulation(const AssociationId& id, const Law& law, bool stabilise, Derivation derivation)
      : element(find_element(id.element)),
        quadrature(find_quadrature(id.element, id.quadrature)),
        energy(energy_density(law, element.dim, {stabilise})),
        derivation(derivation) {
    check_association(id, law);
  }
  [[nodiscard]] ElementGraph graph(const Law& law, Geometry geometry) const {
    return build_element_graph(law, energy, element, quadrature, geometry, derivation);
  }
  const Element& element;
  const Quadrature& quadrature;
  EnergyDensity energy;
  Derivation derivation;
};

/// Values of one element's operations on any arithmetic.
template <class Arithmetic, class FromDouble, class Text>
Evaluation evaluated(const VariantKernels& kernels, const std::vector<std::vector<NodeId>>& inputs,
                     const ElementCase& values, const Arithmetic& arithmetic,
                     const FromDouble& from_double, const Text& text) {
  using Number = typename Arithmetic::Number;
  std::vector<Number> value_of(kernels.dag.size());
  const std::vector<double>* const given[] = {&values.rest_positions, &values.parameters,
                                              &values.displacement};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < inputs[k].size(); ++i) {
      value_of[inputs[k][i]] = from_double((*given[k])[i]);
    }
  }
  const auto along = [&](const std::vector<double>& direction) {
    for (std::size_t i = 0; i < inputs[3].size(); ++i) {
      value_of[inputs[3][i]] = from_double(direction[i]);
    }
  };
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
  const auto texts = [&](const std::vector<Number>& numbers) {
    std::vector<std::string> result;
    for (const Number& number : numbers) result.push_back(text(number));
    return result;
  };
  Evaluation result;
  result.energy = text(add_up("energy")[0]);
  result.forces = texts(add_up("forces"));
  if (!values.direction.empty()) {
    along(values.direction);
    result.product = texts(add_up("product"));
  }
  const std::size_t num_dofs = inputs[3].size();
  result.stiffness.resize(num_dofs * num_dofs);
  for (std::size_t j = 0; j < num_dofs; ++j) {
    std::vector<double> unit(num_dofs, 0.0);
    unit[j] = 1.0;
    along(unit);
    const std::vector<Number> column = add_up("product");
    for (std::size_t i = 0; i < num_dofs; ++i) {
      result.stiffness[i * num_dofs + j] = text(arithmetic.multiply(from_double(-1.0), column[i]));
    }
  }
  result.status = "ok";
  for (const Piece& piece : kernels.operation("energy").pieces) {
    for (const Number& margin : evaluate<Arithmetic>(kernels.dag, piece.margins, arithmetic,
                                                     [&](NodeId id) { return value_of[id]; })) {
      if (!(margin > from_double(0.0))) {
        result.status =
            "outside the law's domain: the argument of a logarithm or root is not positive";
      }
    }
  }
  return result;
}

}  // namespace

void check_association(const AssociationId& id, const Law& law) {
  if (find_quadrature(id.element, id.quadrature).polynomial_laws_only && !law.polynomial) {
    throw InputError(fmt::format(
        "association '{}': quadrature '{}' integrates analytically, which needs an energy that is "
        "polynomial in the displacement gradient; that of law '{}' is not; take one of the other "
        "quadratures of '{}' (elastogen list --law {} --element {})",
        id.text(), id.quadrature, id.law, id.element, id.law, id.element));
  }
}

std::string generator_fingerprint() { return ELASTOGEN_GENERATOR_FINGERPRINT; }

std::string association_hash(const AssociationId& id, const Law& law,
                             const GenerateOptions& options) {
  const std::string chosen =
      fmt::format("{} {} {} {} {} {}", id.text(), options.profile,
                  options.grouping == Grouping::algorithm6 ? "algorithm6" : "minimum-cut",
                  options.derivation == Derivation::ginac ? "ginac" : "dag",
                  options.stabilise ? "stabilised" : "textbook", kernel_abi_version);
  return content_hash({generator_version, chosen, law.text});
}

GeneratedAssociation generate_association(const AssociationId& id, const Law& law,
                                          const GenerateOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Profile& profile = find_profile(options.profile);
  const Formulation formulation(id, law, options.stabilise, options.derivation);

  GeneratedAssociation result;
  result.id = id;
  result.hash = association_hash(id, law, options);
  std::optional<Split> split;
  std::vector<VariantKernels> variants;
  for (const Geometry geometry : geometries_of(formulation.element)) {
    StageLog log;
    ElementGraph graph = formulation.graph(law, geometry);
    log.end("element_graph", graph.dag.size());
    if (!split) {
      const ChosenSplit chosen = choose_split(id, graph, formulation.element, profile);
      split = chosen.split;
      result.chosen_split = chosen.split.text();
      result.split_reason = chosen.reason;
      log.end("choose_split", graph.dag.size());
    }
    variants.push_back(
        build_kernels(std::move(graph), geometry, *split, profile, options.grouping, log));
    result.variants.push_back(report_of(variants.back()));
    result.variants.back().stages = log.records();
  }
  Provenance provenance{
      id.text(),
      law.title,
      law.source,
      {},
      id.element,
      id.quadrature,
      id.split == "auto" ? fmt::format("auto: {} ({})", result.chosen_split, result.split_reason)
                         : id.split,
      options.derivation == Derivation::ginac ? profile.name + ", derivatives by GiNaC"
                                              : profile.name,
      result.hash};
  for (const LawTerm& term : law.terms) {
    provenance.law_terms.push_back(fmt::format("{}: {}", term.name, term.text));
  }
  result.header = print_cpp_header(id, provenance, variants, result.variants);
  result.opencl = print_opencl(id, provenance, variants, result.variants);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string registration_symbol(const AssociationId& id, const Instantiation& what) {
  return fmt::format("elastogen_kernels_{}_{}_{}", id.identifier(),
                     what.single_precision ? "f32" : "f64", what.simd ? "simd" : "scalar");
}

std::string registration_source(const AssociationId& id, const Law& law,
                                const Instantiation& what) {
  std::vector<std::string> parameter_names, geometries;
  for (const Parameter& parameter : law.parameters) parameter_names.push_back(parameter.name);
  for (const Geometry geometry : geometries_of(find_element(id.element))) {
    geometries.push_back(geometry_name(geometry));
  }
  return print_cpp_registration(id, parameter_names, geometries, what);
}

std::string dot_graph(const AssociationId& id, const Law& law, const GenerateOptions& options,
                      const std::string& operation) {
  const Profile& profile = find_profile(options.profile);
  const Formulation formulation(id, law, options.stabilise, options.derivation);
  ElementGraph graph = formulation.graph(law, Geometry::general);
  const Split split = choose_split(id, graph, formulation.element, profile).split;
  StageLog log;
  const VariantKernels kernels =
      build_kernels(std::move(graph), Geometry::general, split, profile, options.grouping, log);
  std::vector<LabelledRoot> roots;
  for (const Piece& piece : kernels.operation(operation).pieces) {
    for (std::size_t k = 0; k < piece.roots.size(); ++k) {
      roots.push_back({fmt::format("{}[{}]", operation, piece.outputs[k]), piece.roots[k]});
    }
  }
  return print_dot(kernels.dag, roots, kernels.constants, id.text());
}

Evaluation evaluate_graph(const AssociationId& id, const Law& law, const ElementCase& input,
                          GraphScalar scalar, const GenerateOptions& options) {
  const bool is_reference = scalar != GraphScalar::dag_double;
  const Formulation formulation(
      id, law, !is_reference && options.stabilise,
      scalar == GraphScalar::cln_expanded ? Derivation::dag : options.derivation);
  ElementGraph graph = formulation.graph(law, Geometry::general);
  std::vector<std::vector<std::string>> names;
  for (const auto* nodes :
       {&graph.positions, &graph.parameters, &graph.displacement, &graph.direction}) {
    names.emplace_back();
    for (const NodeId node : *nodes) names.back().push_back(graph.dag.symbol_name(node));
  }
  const std::vector<Stage> stages{Stage::rest, Stage::material, Stage::state, Stage::direction};
  const Profile& profile = find_profile(options.profile);
  VariantKernels kernels;
  if (scalar == GraphScalar::dag_double) {
    const Split split = choose_split(id, graph, formulation.element, profile).split;
    StageLog log;
    kernels = build_kernels(std::move(graph), Geometry::general, split, profile,
                            Grouping::minimum_cut, log);
  } else {
    kernels = scalar == GraphScalar::cln ? unoptimised_kernels(std::move(graph))
                                         : expanded_kernels(std::move(graph));
  }
  std::vector<std::vector<NodeId>> inputs;
  for (std::size_t k = 0; k < names.size(); ++k) {
    inputs.emplace_back();
    for (const std::string& name : names[k]) {
      inputs.back().push_back(kernels.dag.symbol(name, stages[k]));
    }
  }
  if (scalar == GraphScalar::dag_double) {
    bool finite = true;
    Evaluation result = evaluated(
        kernels, inputs, input, DoubleArithmetic{}, [](double value) { return value; },
        [&finite](double value) {
          finite = finite && std::isfinite(value);
          return fmt::format("{:.17g}", value);
        });
    if (!finite && result.status == "ok") result.status = "not finite: a result is NaN or infinite";
    return result;
  }
  constexpr int shown_digits = 40;
  const ClnArithmetic arithmetic(100);  // the textbook form loses some near rest
  try {
    return evaluated(
        kernels, inputs, input, arithmetic,
        [&](double value) { return arithmetic.from_double(value); },
        [](const cln::cl_R& value) { return decimal_text(value, shown_digits); });
  } catch (const OutsideDomain& outside) {
    Evaluation result;
    result.status = outside.what();
    return result;
  }
}

}  // namespace elastogen::symgen
