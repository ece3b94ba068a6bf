#include "symgen/variant_kernels.h"

#include <algorithm>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

long flops_of(const OperationKernels& operation) {
  long flops = 0;
  for (const Fragment& fragment : operation.fragments) flops += fragment.operations.flops();
  return flops;
}

}  // namespace

bool is_nodal(const std::string& operation) {
  return operation == "forces" || operation == "product" || operation == "apply";
}

bool reads(const OperationKernels& operation, Slot slot) {
  return std::any_of(operation.fragments.begin(), operation.fragments.end(),
                     [&](const Fragment& each) { return !indices_read(each, slot).empty(); });
}

long VariantKernels::flops(const std::string& name) const {
  const OperationKernels& kernel = operation(name);
  const long flops = flops_of(kernel);
  if (!loop || name == "geometry") return flops;
  if (name == "constants" && loop->is_affine) return flops_of(loop->jacobian) + flops;
  long total = static_cast<long>(num_points) * flops;
  for (const Slot field : {Slot::position, Slot::displacement, Slot::direction}) {
    if (!reads(kernel, field)) continue;
    const bool is_same = field == Slot::position && loop->is_affine;
    total += flops_of(is_same ? loop->jacobian : loop->interpolate);
  }
  if (name == "energy") total += flops_of(loop->weigh);
  if (is_nodal(name)) total += flops_of(loop->integrate);
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
