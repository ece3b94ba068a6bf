#include "symgen/variant_kernels.h"

#include <algorithm>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

OperationCount count_of(const OperationKernels& operation) {
  OperationCount count;
  for (const Fragment& fragment : operation.fragments) count += fragment.operations;
  return count;
}

}  // namespace

bool is_nodal(const std::string& operation) {
  return operation == "forces" || operation == "product" || operation == "apply";
}

bool reads(const OperationKernels& operation, Slot slot) {
  return std::any_of(operation.fragments.begin(), operation.fragments.end(),
                     [&](const Fragment& each) { return !indices_read(each, slot).empty(); });
}

OperationCount VariantKernels::operations_of(const std::string& name) const {
  const OperationKernels& kernel = operation(name);
  const OperationCount of_kernel = count_of(kernel);
  if (!loop || name == "geometry") return of_kernel;
  const bool is_once = name == "constants" && loop->is_affine;
  OperationCount total = of_kernel.times(is_once ? 1 : num_points);
  for (const Slot field : {Slot::position, Slot::displacement, Slot::direction}) {
    if (!reads(kernel, field)) continue;
    const bool is_same = field == Slot::position && loop->is_affine;
    total += count_of(is_same ? loop->jacobian : loop->interpolate);
  }
  if (name == "energy") total += count_of(loop->weigh);
  if (is_nodal(name)) total += count_of(loop->integrate);
  return total;
}

int VariantKernels::num_outputs(const OperationKernels& operation) const {
  if (!loop) return operation.num_outputs;
  if (is_nodal(operation.name)) return num_nodes * dim;
  if (operation.name == "constants") return num_stored_constants();
  return operation.name == "linearize" ? num_stored_state() : operation.num_outputs;
}

int VariantKernels::num_constant_sets() const { return loop && !loop->is_affine ? num_points : 1; }

int VariantKernels::num_stored_constants() const {
  return num_constant_sets() * static_cast<int>(constants.size());
}

int VariantKernels::num_stored_state() const { return (loop ? num_points : 1) * num_state; }

const OperationKernels& VariantKernels::operation(const std::string& name) const {
  for (const OperationKernels& candidate : operations) {
    if (candidate.name == name) return candidate;
  }
  throw InternalError("no operation named " + name);
}

}  // namespace elastogen::symgen
