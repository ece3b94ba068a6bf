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
#include "symgen/dag/dot.h"
#include "symgen/emit/content_hash.h"
#include "symgen/emit/print_cpp.h"
#include "symgen/emit/print_opencl.h"
#include "symgen/formulation.h"
#include "symgen/version.h"

namespace elastogen::symgen {
namespace {

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

}  // namespace elastogen::symgen
