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

std::vector<NodeId> values_of(const Piece& piece) {
  std::vector<NodeId> values = piece.roots;
  values.insert(values.end(), piece.margins.begin(), piece.margins.end());
  return values;
}

void schedule(OperationKernels& operation, const Dag& dag, const Inputs& inputs, bool in_steps) {
  const bool is_one = operation.pieces.size() == 1;
  const SumStyle style = is_one ? SumStyle::grouped : SumStyle::plain;
  for (const Piece& piece : operation.pieces) {
    const std::vector<NodeId> values = values_of(piece);
    std::vector<int> outputs = piece.outputs;
    outputs.resize(values.size(), Output::margin);
    operation.fragments.push_back(make_fragment(dag, values, outputs, inputs, style));
    if (in_steps && is_one) operation.steps = make_steps(dag, values, outputs, inputs, style);
  }
}

bool is_nodal(const std::string& operation) {
  return operation == "forces" || operation == "product" || operation == "apply";
}

bool reads_weights(const std::string& operation) { return operation == "stress"; }

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
    const bool is_weight = field == Slot::direction && reads_weights(name);
    if (is_weight || !reads(kernel, field)) continue;
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
