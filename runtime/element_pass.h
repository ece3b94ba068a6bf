// One kernel over the batches of one share: gather, compute, consume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/element_status.h"
#include "runtime/thread_plan.h"

namespace elastogen {

/// Element-local arrays of one thread, large enough for every group.
template <class Scalar>
struct Workspace {
  /// @param matrices  whether `output` must hold element matrices
  Workspace(const std::vector<ElementGroup<Scalar>>& groups, bool matrices);

  AlignedVector<Scalar> displacement;
  AlignedVector<Scalar> direction;
  AlignedVector<Scalar> output;
};

/// Which kernel, and what it reads.
template <class Scalar>
struct ElementPass {
  KernelFunction<Scalar> VariantTable<Scalar>::*kernel = nullptr;
  const double* displacement = nullptr;  ///< global vector, null: not read
  const double* direction = nullptr;     ///< likewise
};

/// Calls the kernel on one batch.
template <class Layout, class Scalar>
[[nodiscard]] inline ElementStatus compute_batch(const ElementGroup<Scalar>& group,
                                                 std::size_t batch, const ElementPass<Scalar>& pass,
                                                 Workspace<Scalar>& workspace, Scalar* output) {
  const std::int32_t* dofs =
      group.dofs.data() + batch * static_cast<std::size_t>(group.num_nodes * Layout::lanes);
  KernelArguments<Scalar> arguments = group.arguments(batch);
  if (pass.displacement != nullptr) {
    Layout::gather(dofs, group.num_nodes, pass.displacement, workspace.displacement.data());
    arguments.displacement = workspace.displacement.data();
  }
  if (pass.direction != nullptr) {
    Layout::gather(dofs, group.num_nodes, pass.direction, workspace.direction.data());
    arguments.direction = workspace.direction.data();
  }
  arguments.output = output;
  alignas(kernel_alignment) std::uint32_t flags[Layout::lanes] = {};
  arguments.status = flags;
  (group.kernels->*pass.kernel)(&arguments, 1);
  std::uint32_t any = status_ok;
  for (int l = 0; l < Layout::lanes; ++l) any |= flags[l];
  return any == status_ok ? ElementStatus{} : batch_status(group, batch, flags);
}

/// Runs `pass` over a share. After each batch `consume(layout, group, batch, output)` is called
/// with the batch's result.
template <class Scalar, class Consume>
[[nodiscard]] ElementStatus run_pass(const std::vector<ElementGroup<Scalar>>& groups,
                                     const ThreadShare& share, const ElementPass<Scalar>& pass,
                                     Workspace<Scalar>& workspace, Consume&& consume) {
  ElementStatus status;
  for (const BatchRange& range : share.ranges) {
    const ElementGroup<Scalar>& group = groups[range.group];
    with_layout(group, [&](auto layout) {
      using Layout = decltype(layout);
      Scalar* output = workspace.output.data();
      for (std::size_t batch = range.begin; batch < range.end; ++batch) {
        status.merge(compute_batch<Layout>(group, batch, pass, workspace, output));
        consume(layout, group, batch, static_cast<const Scalar*>(output));
      }
    });
  }
  return status;
}

}  // namespace elastogen
