#include "symgen/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
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

/// Numbers of an input array that one element reads.
std::size_t numbers_read(const VariantKernels& kernels, const OperationKernels& operation,
                         Slot slot) {
  std::set<int> indices;
  for (const Fragment& fragment : operation.fragments) indices.merge(indices_read(fragment, slot));
  const std::size_t read = indices.size();
  if (!kernels.loop || operation.name == "geometry") return read;
  switch (slot) {
    case Slot::constant:
      return read * static_cast<std::size_t>(kernels.num_constant_sets());
    case Slot::state:
      return read * static_cast<std::size_t>(kernels.num_points);
    case Slot::direction:
      if (reads_weights(operation.name)) return 0;
      [[fallthrough]];
    default:  // nodal values, of which gradients are interpolated
      return read > 0 ? static_cast<std::size_t>(kernels.num_nodes * kernels.dim) : 0;
  }
}

OperationReport report_of(const VariantKernels& kernels, const OperationKernels& operation) {
  OperationReport report;
  report.name = operation.name;
  report.flops = kernels.flops(operation.name);
  report.fragments = static_cast<int>(operation.fragments.size());
  const int num_outputs = kernels.num_outputs(operation);
  report.constants = operation.name == "constants"
                         ? num_outputs
                         : static_cast<int>(numbers_read(kernels, operation, Slot::constant));
  report.state = operation.name == "linearize"
                     ? num_outputs
                     : static_cast<int>(numbers_read(kernels, operation, Slot::state));
  for (const Slot slot :
       {Slot::position, Slot::constant, Slot::displacement, Slot::direction, Slot::state}) {
    report.bytes_read += static_cast<long>(sizeof(double) * numbers_read(kernels, operation, slot));
  }
  report.bytes_written = static_cast<long>(sizeof(double)) * num_outputs;
  return report;
}

VariantReport report_of(const VariantKernels& kernels) {
  VariantReport report;
  report.geometry = geometry_name(kernels.geometry);
  report.num_constants = kernels.num_stored_constants();
  report.num_state = kernels.num_stored_state();
  report.reads_positions = kernels.reads_positions;
  report.constants_algorithm6 = kernels.num_constant_sets() * kernels.constants_algorithm6;
  for (const OperationKernels& operation : kernels.operations) {
    report.operations.push_back(report_of(kernels, operation));
  }
  const OperationReport linearize = report_of(kernels, kernels.operation("linearize"));
  const OperationReport apply = report_of(kernels, kernels.operation("apply"));
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
  const ChosenSplit chosen = choose_split(id, formulation, law, profile);
  result.chosen_split = chosen.split.text();
  result.split_reason = chosen.reason;
  std::vector<VariantKernels> variants;
  for (const Geometry geometry : geometries_of(formulation.element)) {
    StageLog log;
    variants.push_back(
        kernels_of(formulation, law, geometry, chosen.split, profile, options.grouping, log));
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
  const Element& element = find_element(id.element);
  const Quadrature& quadrature = find_quadrature(id.element, id.quadrature);
  const Quadrature& rich = richest_quadrature(id.element);
  Registration registration{id, {}, {}, reference_points(element, quadrature), std::nullopt};
  for (const Parameter& parameter : law.parameters) {
    registration.parameter_names.push_back(parameter.name);
  }
  for (const Geometry geometry : geometries_of(element)) {
    registration.geometries.push_back(geometry_name(geometry));
  }
  if (rich.name != quadrature.name) registration.rich_points = reference_points(element, rich);
  return print_cpp_registration(registration, what);
}

std::string dot_graph(const AssociationId& id, const Law& law, const GenerateOptions& options,
                      const std::string& operation) {
  const Profile& profile = find_profile(options.profile);
  const Formulation formulation(id, law, options.stabilise, options.derivation);
  const Split split = choose_split(id, formulation, law, profile).split;
  StageLog log;
  const VariantKernels kernels =
      kernels_of(formulation, law, Geometry::general, split, profile, options.grouping, log);
  std::vector<LabelledRoot> roots;
  for (const Piece& piece : kernels.operation(operation).pieces) {
    for (std::size_t k = 0; k < piece.roots.size(); ++k) {
      roots.push_back({fmt::format("{}[{}]", operation, piece.outputs[k]), piece.roots[k]});
    }
  }
  return print_dot(kernels.dag, roots, kernels.constants, id.text());
}

}  // namespace elastogen::symgen
