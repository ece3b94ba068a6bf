// One kernel over the batches of one share: gather, compute, consume.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/element_status.h"
#include "runtime/thread_plan.h"

namespace elastogen {

/// Element-local arrays of one thread, large enough for every group.
struct Workspace {
  /// @param matrices  whether `output` must hold element matrices
  Workspace(const std::vector<ElementGroup>& groups, bool matrices);

  AlignedVector<double> displacement;
  AlignedVector<double> direction;
  AlignedVector<double> output;
};

/// Which kernel, and what it reads.
struct ElementPass {
  KernelFunction<double> VariantTable<double>::*kernel = nullptr;
  const double* displacement = nullptr;  ///< global vector, null: not read
  const double* direction = nullptr;     ///< likewise
  double scale = 1;
};

/// Calls the kernel on one batch; `output` must be as the kernel expects it.
template <class Layout>
[[nodiscard]] inline ElementStatus compute_batch(const ElementGroup& group, std::size_t batch,
                                                 const ElementPass& pass, Workspace& workspace,
                                                 double* output) {
  const std::int32_t* dofs =
      group.dofs.data() + batch * static_cast<std::size_t>(group.num_nodes * Layout::lanes);
  KernelArguments<double> arguments = group.arguments(batch);
  if (pass.displacement != nullptr) {
    Layout::gather(dofs, group.num_nodes, pass.displacement, workspace.displacement.data());
    arguments.displacement = workspace.displacement.data();
  }
  if (pass.direction != nullptr) {
    Layout::gather(dofs, group.num_nodes, pass.direction, workspace.direction.data());
    arguments.direction = workspace.direction.data();
  }
  arguments.scale = pass.scale;
  arguments.output = output;
  alignas(kernel_alignment) std::uint32_t flags[Layout::lanes] = {};
  arguments.status = flags;
  (group.kernels->*pass.kernel)(arguments);
  std::uint32_t any = status_ok;
  for (int l = 0; l < Layout::lanes; ++l) any |= flags[l];
  return any == status_ok ? ElementStatus{} : batch_status(group, batch, flags);
}

/// Runs `pass` over a share whose kernels accumulate `values_per_node` numbers per node of the
/// element (forces, product), or one number per element (0: energy). After each batch
/// `consume(layout, group, batch, output)` is called with the batch's result.
template <class Consume>
[[nodiscard]] ElementStatus run_pass(const std::vector<ElementGroup>& groups,
                                     const ThreadShare& share, const ElementPass& pass,
                                     int values_per_node, Workspace& workspace, Consume&& consume) {
  ElementStatus status;
  for (const BatchRange& range : share.ranges) {
    const ElementGroup& group = groups[range.group];
    const int values = values_per_node == 0 ? 1 : values_per_node * group.num_nodes;
    with_layout(group, [&](auto layout) {
      using Layout = decltype(layout);
      double* output = workspace.output.data();
      for (std::size_t batch = range.begin; batch < range.end; ++batch) {
        std::fill_n(output, values * Layout::lanes, 0.0);
        status.merge(compute_batch<Layout>(group, batch, pass, workspace, output));
        consume(layout, group, batch, static_cast<const double*>(output));
      }
    });
  }
  return status;
}

}  // namespace elastogen
