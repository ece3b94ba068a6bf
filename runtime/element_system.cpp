#include "runtime/element_system.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/error.h"
#include "runtime/stopwatch.h"

namespace elastogen {
namespace {

template <class Scalar>
int count_threads(int asked, const std::vector<ElementGroup<Scalar>>& groups) {
  if (asked < 0) throw InputError(fmt::format("threads = {}; must be 0 (all) or more", asked));
  return asked > 0 ? asked : useful_threads(groups, omp_get_max_threads());
}

// Adds the diagonal blocks of one batch of element matrices to node_blocks, which starts at node
// node_begin.
template <class Layout, class Scalar>
void add_diagonal_blocks(const ElementGroup<Scalar>& group, std::size_t batch,
                         const Scalar* matrices, std::int32_t node_begin, double* node_blocks) {
  constexpr int dim = Layout::dim;
  constexpr int lanes = Layout::lanes;
  const int n = group.num_nodes;
  const std::int32_t* dofs = group.dofs.data() + batch * static_cast<std::size_t>(n * lanes);
  for (int a = 0; a < n; ++a) {
    for (int l = 0; l < group.used_lanes(batch); ++l) {
      double* block = node_blocks + (dofs[a * lanes + l] / dim - node_begin) * dim * dim;
      for (int i = 0; i < dim; ++i) {
        const Scalar* row = matrices + ((a * dim + i) * n + a) * dim * lanes + l;
        for (int j = 0; j < dim; ++j) block[i * dim + j] += row[j * lanes];
      }
    }
  }
}

// Goes through batches one by one after a pass over them found something bad.
template <class Scalar>
ElementStatus first_bad_element(const ElementGroup<Scalar>& group, const BatchRange& range,
                                const ElementPass<Scalar>& pass, Workspace<Scalar>& workspace) {
  ElementStatus first;
  with_layout(group, [&](auto layout) {
    for (std::size_t batch = range.begin; batch < range.end; ++batch) {
      first.merge(
          compute_batch<decltype(layout)>(group, batch, pass, workspace, workspace.output.data()));
    }
  });
  return first;
}

}  // namespace

void CompensatedSum::add(double value) {
  const double next = sum + value;
  lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
  sum = next;
}

template <class Scalar>
ElementSystem<Scalar>::ElementSystem(std::vector<ElementGroup<Scalar>> groups,
                                     std::size_t num_nodes, int dim, int threads, bool two_stage,
                                     bool renumber)
    : num_nodes_(num_nodes),
      dim_(dim),
      groups_(std::move(groups)),
      numbering_(renumber ? NodeNumbering(groups_, num_nodes) : NodeNumbering()),
      threads_(count_threads(threads, groups_)),
      plan_(groups_, moving_batches(groups_), threads_, dim * dim),
      workspaces_(plan_.shares.size(), Workspace<Scalar>(groups_, true)),
      statuses_(plan_.shares.size()),
      sums_(plan_.shares.size()) {
  point_.assign(num_nodes_ * static_cast<std::size_t>(dim_), 0.0);
  for (ElementGroup<Scalar>& group : groups_) {
    compute_constants(group, threads_);
    if (!two_stage || group.at_rest) continue;
    group.state.resize(group.num_batches * static_cast<std::size_t>(group.lanes) *
                       static_cast<std::size_t>(group.kernels->num_state));
  }
}

template <class Scalar>
void ElementSystem<Scalar>::require(KernelFunction<Scalar> VariantTable<Scalar>::*kernel,
                                    const char* name) const {
  for (const ElementGroup<Scalar>& group : groups_) {
    if (group.kernels->*kernel != nullptr) continue;
    throw InternalError(fmt::format("kernels of {} ({}) were generated without the operation '{}'",
                                    group.table->association, group.kernels->geometry, name));
  }
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::merged_status() const {
  ElementStatus first;
  for (const ElementStatus& status : statuses_) first.merge(status);
  return first;
}

template <class Scalar>
StiffnessAssembly<Scalar>& ElementSystem<Scalar>::stiffness_assembly() {
  if (!assembly_) assembly_.emplace(groups_, numbering_, num_nodes_, dim_, threads_);
  return *assembly_;
}

// A vector of the mesh in the numbers of passes, until the next call.
template <class Scalar>
const double* ElementSystem<Scalar>::for_passes(const double* vector) {
  if (numbering_.is_of_mesh()) return vector;
  input_.resize(point_.size());
  numbering_.copy_from_mesh(vector, dim_, threads_, input_.data());
  return input_.data();
}

// out[node * values_per_node + i] += what the shares compute; `compute` as NodeAccumulator has it.
template <class Scalar>
template <class Compute>
void ElementSystem<Scalar>::accumulate(PassPlan& plan, int values_per_node, double* out,
                                       Compute&& compute) {
  if (numbering_.is_of_mesh()) {
    plan.accumulator.run(plan.shares, values_per_node, out, compute);
    return;
  }
  sum_.assign(num_nodes_ * static_cast<std::size_t>(values_per_node), 0.0);
  plan.accumulator.run(plan.shares, values_per_node, sum_.data(), compute);
  numbering_.add_to_mesh(sum_.data(), values_per_node, threads_, out);
}

// Runs a pass whose kernels give numbers per element node: sum[dof - first_dof] += scale * each.
template <class Scalar>
ElementStatus ElementSystem<Scalar>::add_batches(const BatchRange& batches,
                                                 const ElementPass<Scalar>& pass, double scale,
                                                 double* sum, std::int32_t first_dof,
                                                 Workspace<Scalar>& workspace) {
  const ElementGroup<Scalar>& group = groups_[batches.group];
  NodalPass<Scalar> nodal = group.nodal_pass();
  nodal.kernel = group.kernels->*pass.kernel;
  nodal.begin = batches.begin;
  nodal.end = batches.end;
  nodal.displacement = pass.displacement;
  nodal.direction = pass.direction;
  nodal.scale = scale;
  nodal.sum = sum;
  nodal.first_dof = first_dof;
  if (group.table->nodal_pass(nodal) == status_ok) return {};
  return first_bad_element(group, batches, pass, workspace);
}

// The same over all that the plan has: out += scale * their sum.
template <class Scalar>
ElementStatus ElementSystem<Scalar>::add_nodal(PassPlan& plan, const ElementPass<Scalar>& pass,
                                               double scale, double* out) {
  const Stopwatch watch(counts_.seconds);
  ++counts_.passes;
  accumulate(plan, dim_, out, [&](int s, std::int32_t node_begin, double* array) {
    const std::size_t thread = static_cast<std::size_t>(s);
    ElementStatus first;
    for (const BatchRange& range : plan.shares[thread].ranges) {
      first.merge(add_batches(range, pass, scale, array, node_begin * dim_, workspaces_[thread]));
    }
    statuses_[thread] = first;
  });
  return merged_status();
}

// Finds out what sleeps, and adds the forces that were kept of it.
template <class Scalar>
ElementStatus ElementSystem<Scalar>::add_sleeping_forces(const ElementPass<Scalar>& pass,
                                                         double* f) {
  const Stopwatch watch(counts_.seconds_of_sleep);
  ElementStatus first;
  sleeping_->follow(pass.displacement, threads_);
  if (sleeping_->has_changed() || !awake_plan_) {
    const std::size_t length = num_nodes_ * static_cast<std::size_t>(dim_);
    AlignedVector<double> scratch(length, 0.0);
    for (const std::size_t region : sleeping_->falling_asleep()) {
      first.merge(
          add_batches(sleeping_->batches(region), pass, 1, scratch.data(), 0, workspaces_[0]));
      sleeping_->keep(region, scratch.data());
    }
    sleeping_->add_kept(scratch.data());
    if (numbering_.is_of_mesh()) {
      kept_forces_ = std::move(scratch);
    } else {
      kept_forces_.assign(length, 0.0);
      numbering_.add_to_mesh(scratch.data(), dim_, threads_, kept_forces_.data());
    }
    awake_plan_.emplace(groups_, sleeping_->awake(), threads_, dim_);
  }
  const auto length = static_cast<std::ptrdiff_t>(kept_forces_.size());
#pragma omp parallel for simd schedule(static) num_threads(threads_)
  for (std::ptrdiff_t k = 0; k < length; ++k) f[k] += kept_forces_[static_cast<std::size_t>(k)];
  counts_.slept += static_cast<std::int64_t>(sleeping_->num_sleeping_elements());
  return first;
}

// Calls `compute(thread)` for every share, in parallel; it returns the first bad element.
template <class Scalar>
template <class Compute>
ElementStatus ElementSystem<Scalar>::for_each_share(Compute&& compute) {
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int s = 0; s < threads_; ++s) {
    const std::size_t thread = static_cast<std::size_t>(s);
    statuses_[thread] = compute(thread);
  }
  return merged_status();
}

// Runs the energy kernel; `consume(thread, group, batch, energies)` takes each batch's result.
template <class Scalar>
template <class Consume>
ElementStatus ElementSystem<Scalar>::for_each_energy(const double* u, Consume&& consume) {
  require(&VariantTable<Scalar>::energy, "energy");
  ElementPass<Scalar> pass;
  pass.kernel = &VariantTable<Scalar>::energy;
  pass.displacement = for_passes(u);
  return for_each_share([&](std::size_t thread) {
    return run_pass(groups_, plan_.shares[thread], pass, workspaces_[thread],
                    [&](auto, const ElementGroup<Scalar>& group, std::size_t batch,
                        const Scalar* energies) { consume(thread, group, batch, energies); });
  });
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::energy(const double* u, double& energy) {
  std::fill(sums_.begin(), sums_.end(), CompensatedSum{});
  const ElementStatus status =
      for_each_energy(u, [&](std::size_t thread, const ElementGroup<Scalar>& group,
                             std::size_t batch, const Scalar* energies) {
        double sum = 0;
        for (int l = 0; l < group.used_lanes(batch); ++l) sum += energies[l];
        sums_[thread].add(sum);
      });
  CompensatedSum total;
  for (const CompensatedSum& sum : sums_) total.add(sum.value());
  energy = total.value();
  return status;
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::element_energies(const double* u, double* energies) {
  return for_each_energy(u, [&](std::size_t, const ElementGroup<Scalar>& group, std::size_t batch,
                                const Scalar* values) {
    const std::int32_t* elements =
        group.elements.data() + batch * static_cast<std::size_t>(group.lanes);
    for (int l = 0; l < group.used_lanes(batch); ++l) energies[elements[l]] = values[l];
  });
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::forces(const double* u, double* f) {
  require(&VariantTable<Scalar>::forces, "forces");
  ElementPass<Scalar> pass;
  pass.kernel = &VariantTable<Scalar>::forces;
  pass.displacement = for_passes(u);
  if (!sleeping_) return add_nodal(plan_, pass, 1, f);
  ElementStatus first = add_sleeping_forces(pass, f);
  first.merge(add_nodal(*awake_plan_, pass, 1, f));
  return first;
}

template <class Scalar>
void ElementSystem<Scalar>::set_point(const double* u) {
  if (numbering_.is_of_mesh()) {
    std::copy_n(u, point_.size(), point_.data());
  } else {
    numbering_.copy_from_mesh(u, dim_, threads_, point_.data());
  }
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::store_states() {
  ElementPass<Scalar> pass;
  pass.kernel = &VariantTable<Scalar>::linearize;
  pass.displacement = point_.data();
  return for_each_share([&](std::size_t thread) {
    ElementStatus first;
    for (const BatchRange& range : plan_.shares[thread].ranges) {
      ElementGroup<Scalar>& group = groups_[range.group];
      with_layout(group, [&](auto layout) {
        const std::size_t size = static_cast<std::size_t>(group.kernels->num_state * layout.lanes);
        for (std::size_t batch = range.begin; batch < range.end; ++batch) {
          first.merge(compute_batch<decltype(layout)>(group, batch, pass, workspaces_[thread],
                                                      group.state.data() + batch * size));
        }
      });
    }
    return first;
  });
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::product(const double* v, double scale, double* df) {
  require(&VariantTable<Scalar>::product, "product");
  return add_nodal(plan_, {&VariantTable<Scalar>::product, point_.data(), for_passes(v)}, scale,
                   df);
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::apply(const double* v, double scale, double* df) {
  return add_nodal(plan_, {&VariantTable<Scalar>::apply, nullptr, for_passes(v)}, scale, df);
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::assemble(TangentForm form,
                                              Eigen::SparseMatrix<double>& stiffness) {
  require(&VariantTable<Scalar>::stiffness, "stiffness");
  shape(stiffness);
  return stiffness_assembly().run(groups_, point_.data(), form, stiffness.valuePtr());
}

template <class Scalar>
ElementStatus ElementSystem<Scalar>::diagonal_blocks(double* blocks) {
  require(&VariantTable<Scalar>::stiffness, "stiffness");
  ElementPass<Scalar> pass;
  pass.kernel = &VariantTable<Scalar>::stiffness;
  pass.displacement = point_.data();
  accumulate(plan_, dim_ * dim_, blocks, [&](int s, std::int32_t node_begin, double* array) {
    const std::size_t thread = static_cast<std::size_t>(s);
    statuses_[thread] =
        run_pass(groups_, plan_.shares[thread], pass, workspaces_[thread],
                 [&](auto layout, const ElementGroup<Scalar>& group, std::size_t batch,
                     const Scalar* matrices) {
                   add_diagonal_blocks<decltype(layout)>(group, batch, matrices, node_begin, array);
                 });
  });
  return merged_status();
}

template class ElementSystem<double>;
template class ElementSystem<float>;

}  // namespace elastogen
