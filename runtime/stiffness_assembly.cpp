#include "runtime/stiffness_assembly.h"

#include <omp.h>

#include <algorithm>

#include "runtime/project_semidefinite.h"

namespace elastogen {
namespace {

// Element matrices that a thread computes before columns are added: enough to hide the barriers,
// few enough to stay in the second cache.
template <class Scalar>
constexpr std::size_t numbers_per_thread = (1u << 17) / sizeof(Scalar);

template <class Scalar>
std::size_t largest_matrix_batch(const std::vector<ElementGroup<Scalar>>& groups) {
  std::size_t size = 0;
  for (const ElementGroup<Scalar>& group : groups) {
    size = std::max(
        size, group.values_per_batch() * static_cast<std::size_t>(group.num_nodes * group.dim));
  }
  return size;
}

/// Projects the matrices of one batch in their place.
template <class Scalar>
void project_batch(const ElementGroup<Scalar>& group, std::size_t batch, Scalar* matrices) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index size = group.num_nodes * group.dim;
  Eigen::MatrixXd matrix(size, size);
  for (int lane = 0; lane < group.used_lanes(batch); ++lane) {
    Eigen::Map<Matrix, Eigen::Unaligned, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>> in_batch(
        matrices + lane, size, size, {size * group.lanes, group.lanes});
    matrix = in_batch.template cast<double>();
    if (project_semidefinite(matrix)) in_batch = matrix.template cast<Scalar>();
  }
}

}  // namespace

template <class Scalar>
StiffnessAssembly<Scalar>::StiffnessAssembly(const std::vector<ElementGroup<Scalar>>& groups,
                                             const NodeNumbering& numbering, std::size_t num_nodes,
                                             int dim, int threads)
    : threads_(threads),
      pattern_(groups, numbering, num_nodes, dim),
      workspaces_(static_cast<std::size_t>(threads), Workspace<Scalar>(groups, false)),
      matrices_(std::max(numbers_per_thread<Scalar>, largest_matrix_batch(groups)) *
                static_cast<std::size_t>(threads)) {}

template <class Scalar>
ElementStatus StiffnessAssembly<Scalar>::run(const std::vector<ElementGroup<Scalar>>& groups,
                                             const double* displacement, TangentForm form,
                                             double* values) {
  ElementPass<Scalar> pass;
  pass.kernel = &VariantTable<Scalar>::stiffness;
  pass.displacement = displacement;
  std::fill_n(values, pattern_.num_values(), 0.0);
  std::vector<ElementStatus> status(static_cast<std::size_t>(threads_));

#pragma omp parallel num_threads(threads_)
  {
    const int thread = omp_get_thread_num();
    const int num_threads = omp_get_num_threads();
    Workspace<Scalar>& workspace = workspaces_[static_cast<std::size_t>(thread)];
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const ElementGroup<Scalar>& group = groups[g];
      if (group.at_rest) continue;
      const std::size_t size =
          group.values_per_batch() * static_cast<std::size_t>(group.num_nodes * group.dim);
      const std::size_t step = matrices_.size() / size;
      for (std::size_t begin = 0; begin < group.num_batches; begin += step) {
        const std::size_t end = std::min(begin + step, group.num_batches);
        with_layout(group, [&](auto layout) {
          for (std::size_t batch = begin + static_cast<std::size_t>(thread); batch < end;
               batch += static_cast<std::size_t>(num_threads)) {
            Scalar* const matrices = matrices_.data() + (batch - begin) * size;
            const ElementStatus batch_status =
                compute_batch<decltype(layout)>(group, batch, pass, workspace, matrices);
            if (form == TangentForm::semidefinite && batch_status.ok()) {
              project_batch(group, batch, matrices);
            }
            status[static_cast<std::size_t>(thread)].merge(batch_status);
          }
        });
#pragma omp barrier
        with_layout(group, [&](auto layout) {
          for (std::size_t batch = begin; batch < end; ++batch) {
            add_columns<decltype(layout)>(group, g, batch,
                                          matrices_.data() + (batch - begin) * size, thread,
                                          num_threads, values);
          }
        });
#pragma omp barrier
      }
    }
  }
  ElementStatus first;
  for (const ElementStatus& s : status) first.merge(s);
  return first;
}

template <class Scalar>
template <class Layout>
void StiffnessAssembly<Scalar>::add_columns(const ElementGroup<Scalar>& group,
                                            std::size_t group_number, std::size_t batch,
                                            const Scalar* matrices, int thread, int num_threads,
                                            double* values) const {
  constexpr int d = Layout::dim, lanes = Layout::lanes;
  const int n = group.num_nodes;
  const std::int32_t* dofs = group.dofs.data() + batch * static_cast<std::size_t>(n * lanes);
  const std::int32_t* slots =
      pattern_.slots(group_number).data() + batch * static_cast<std::size_t>(lanes * n * n);
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(n) * d * lanes;  // of an element's matrix
  for (int l = 0; l < group.used_lanes(batch); ++l) {
    for (int a = 0; a < n; ++a) {
      const std::int32_t node = dofs[a * lanes + l] / d;
      if (num_threads > 1 && node % num_threads != thread) continue;
      const std::ptrdiff_t column_length = pattern_.column_length(static_cast<std::size_t>(node));
      // K is symmetric: row (a, j) of the element matrix is column (a, j) of the global one.
      const Scalar* from = matrices + a * d * row + l;
      for (int b = 0; b < n; ++b, from += d * lanes) {
        double* const block = values + slots[(l * n + a) * n + b];
        for (int j = 0; j < d; ++j) {
          for (int i = 0; i < d; ++i) {
            block[j * column_length + i] += static_cast<double>(from[j * row + i * lanes]);
          }
        }
      }
    }
  }
}

template class StiffnessAssembly<double>;
template class StiffnessAssembly<float>;

}  // namespace elastogen
