#include "runtime/model.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/element_group.h"
#include "runtime/element_pass.h"
#include "runtime/error.h"
#include "runtime/model_parts.h"
#include "runtime/rest_geometry.h"
#include "runtime/stiffness_assembly.h"
#include "runtime/thread_plan.h"

namespace elastogen {
namespace {

// Sum whose error does not grow with the number of terms: the line search compares energies that
// differ in their last digits. (Neumaier, ZAMM 54 (1974) 39-51.)
struct CompensatedSum {
  double sum = 0;
  double lost = 0;

  void add(double value) {
    const double next = sum + value;
    lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  [[nodiscard]] double value() const { return sum + lost; }
};

int count_threads(int asked, const std::vector<ElementGroup>& groups) {
  if (asked < 0) throw InputError(fmt::format("threads = {}; must be 0 (all) or more", asked));
  return asked > 0 ? asked : useful_threads(groups, omp_get_max_threads());
}

void require_kernel(const std::vector<ElementGroup>& groups,
                    KernelFunction<double> VariantTable<double>::*kernel, const char* name) {
  for (const ElementGroup& group : groups) {
    if (group.kernels->*kernel != nullptr) continue;
    throw InternalError(fmt::format("kernels of {} ({}) were generated without the operation '{}'",
                                    group.table->association, group.kernels->geometry, name));
  }
}

// Adds the diagonal blocks of one batch of element matrices to node_blocks, which starts at node
// node_begin.
template <class Layout>
void add_diagonal_blocks(const ElementGroup& group, std::size_t batch, const double* matrices,
                         std::int32_t node_begin, double* node_blocks) {
  constexpr int dim = Layout::dim;
  constexpr int lanes = Layout::lanes;
  const int n = group.num_nodes;
  const std::int32_t* dofs = group.dofs.data() + batch * static_cast<std::size_t>(n * lanes);
  for (int a = 0; a < n; ++a) {
    for (int l = 0; l < group.used_lanes(batch); ++l) {
      double* block = node_blocks + (dofs[a * lanes + l] / dim - node_begin) * dim * dim;
      for (int i = 0; i < dim; ++i) {
        const double* row = matrices + ((a * dim + i) * n + a) * dim * lanes + l;
        for (int j = 0; j < dim; ++j) block[i * dim + j] += row[j * lanes];
      }
    }
  }
}

const char* status_text(std::uint32_t flags) {
  if ((flags & status_outside_domain) != 0) {
    return "its deformation is outside the domain of its law (turned inside out, flattened, or "
           "where "
           "the law has no derivative)";
  }
  return "its result is not finite";
}

}  // namespace

struct Model::Data {
  int dim = 3;
  std::size_t num_nodes = 0;
  std::size_t num_elements = 0;
  int threads = 1;
  TangentProduct tangent_product = TangentProduct::recompute;
  std::vector<ElementGroup> groups;
  std::vector<ThreadShare> shares;      // [thread]
  std::vector<Workspace> workspaces;    // [thread]
  std::vector<ElementStatus> statuses;  // [thread]
  std::vector<CompensatedSum> sums;     // [thread]
  std::optional<NodeAccumulator> accumulator;
  std::optional<StiffnessAssembly> assembly;  // made when first needed
  Eigen::SparseMatrix<double> stiffness;      // where has_stiffness()
  TangentForm form = TangentForm::exact;
  Vector displacement;  // linearisation point
  std::vector<double> element_volumes, nodal_volumes, nodal_mass, lumped_mass;
  ElementStatus status;

  [[nodiscard]] std::size_t num_dofs() const { return static_cast<std::size_t>(dim) * num_nodes; }

  void check_length(Eigen::Index length, const char* what) const {
    if (static_cast<std::size_t>(length) == num_dofs()) return;
    throw InternalError(fmt::format("{} has {} values, the model has {} degrees of freedom", what,
                                    length, num_dofs()));
  }

  void merge_statuses() {
    status = {};
    for (const ElementStatus& s : statuses) status.merge(s);
  }

  StiffnessAssembly& stiffness_assembly() {
    if (!assembly) assembly.emplace(groups, num_nodes, dim, threads);
    return *assembly;
  }

  // Whether products are those of the assembled stiffness.
  [[nodiscard]] bool has_stiffness() const {
    return form == TangentForm::semidefinite || tangent_product == TangentProduct::assembled;
  }

  void assemble(Eigen::SparseMatrix<double>& matrix) {
    require_kernel(groups, &VariantTable<double>::stiffness, "stiffness");
    stiffness_assembly().pattern().shape(matrix);
    status = stiffness_assembly().run(groups, displacement.data(), form, matrix.valuePtr());
  }

  // Runs a pass whose kernels give numbers per element node and sums them into `out`.
  void add_nodal(const ElementPass& pass, double* out) {
    accumulator->run(shares, dim, out, [&](int s, std::int32_t node_begin, double* array) {
      const std::size_t thread = static_cast<std::size_t>(s);
      const std::int32_t offset = node_begin * dim;
      statuses[thread] = run_pass(
          groups, shares[thread], pass, dim, workspaces[thread],
          [&](auto layout, const ElementGroup& group, std::size_t batch, const double* value) {
            const std::size_t per_batch = static_cast<std::size_t>(group.num_nodes * layout.lanes);
            layout.scatter(group.dofs.data() + batch * per_batch, group.num_nodes,
                           group.used_lanes(batch), value, offset, array);
          });
    });
    merge_statuses();
  }

  // Runs the energy kernel; `consume(thread, group, batch, energies)` takes each batch's result.
  template <class Consume>
  void for_each_energy(const double* u, Consume&& consume) {
    require_kernel(groups, &VariantTable<double>::energy, "energy");
    ElementPass pass;
    pass.kernel = &VariantTable<double>::energy;
    pass.displacement = u;
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int s = 0; s < threads; ++s) {
      const std::size_t thread = static_cast<std::size_t>(s);
      statuses[thread] =
          run_pass(groups, shares[thread], pass, 0, workspaces[thread],
                   [&](auto, const ElementGroup& group, std::size_t batch, const double* energies) {
                     consume(thread, group, batch, energies);
                   });
    }
    merge_statuses();
  }

  void store_states() {
    ElementPass pass;
    pass.kernel = &VariantTable<double>::linearize;
    pass.displacement = displacement.data();
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int s = 0; s < threads; ++s) {
      const std::size_t thread = static_cast<std::size_t>(s);
      ElementStatus first;
      for (const BatchRange& range : shares[thread].ranges) {
        ElementGroup& group = groups[range.group];
        with_layout(group, [&](auto layout) {
          const std::size_t size =
              static_cast<std::size_t>(group.kernels->num_state * layout.lanes);
          for (std::size_t batch = range.begin; batch < range.end; ++batch) {
            first.merge(compute_batch<decltype(layout)>(group, batch, pass, workspaces[thread],
                                                        group.state.data() + batch * size));
          }
        });
      }
      statuses[thread] = first;
    }
    merge_statuses();
  }

  // df -= scale * K v. K is symmetric, so a row is a column: every value is written by one thread.
  void add_assembled_product(const double* v, double scale, double* df) const {
    const int* outer = stiffness.outerIndexPtr();
    const int* inner = stiffness.innerIndexPtr();
    const double* values = stiffness.valuePtr();
    const Eigen::Index rows = stiffness.rows();
#pragma omp parallel for schedule(static) num_threads(threads)
    for (Eigen::Index row = 0; row < rows; ++row) {
      double sum = 0;
      for (int k = outer[row]; k < outer[row + 1]; ++k) sum += values[k] * v[inner[k]];
      df[row] -= scale * sum;
    }
  }
};

Model::Model(const Mesh& mesh, std::span<const ModelPart> parts, const ModelOptions& options)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.tangent_product = options.tangent_product;
  d.groups = make_element_groups(mesh, parts, options.tangent_product);
  d.threads = count_threads(options.threads, d.groups);
  d.dim = mesh.dim;
  d.num_nodes = mesh.num_nodes();
  d.num_elements = mesh.num_elements();
  d.nodal_volumes.assign(d.num_nodes, 0.0);
  d.nodal_mass.assign(d.num_nodes, 0.0);
  d.lumped_mass.assign(d.num_nodes, 0.0);
  d.element_volumes.assign(d.num_elements, 0.0);
  for (ElementGroup& group : d.groups) {
    measure_rest_shapes(group, {d.nodal_volumes, d.nodal_mass, d.lumped_mass, d.element_volumes});
    compute_constants(group, d.threads);
    if (options.tangent_product == TangentProduct::two_stage) {
      group.state.resize(group.num_batches * static_cast<std::size_t>(group.lanes) *
                         static_cast<std::size_t>(group.kernels->num_state));
    }
  }
  d.shares = plan_threads(d.groups, d.threads);
  d.workspaces.assign(d.shares.size(), Workspace(d.groups, true));
  d.statuses.resize(d.shares.size());
  d.sums.resize(d.shares.size());
  d.accumulator.emplace(d.shares, d.dim * d.dim);
  d.displacement = Vector::Zero(static_cast<Eigen::Index>(d.num_dofs()));
  if (options.tangent_product != TangentProduct::recompute) linearize(Vector(d.displacement));
}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

int Model::dim() const { return data_->dim; }
std::size_t Model::num_nodes() const { return data_->num_nodes; }
std::size_t Model::num_dofs() const { return data_->num_dofs(); }
std::size_t Model::num_elements() const { return data_->num_elements; }
int Model::num_threads() const { return data_->threads; }
TangentProduct Model::tangent_product() const { return data_->tangent_product; }
const ElementStatus& Model::status() const { return data_->status; }
std::span<const double> Model::element_volumes() const { return data_->element_volumes; }
std::span<const double> Model::nodal_volumes() const { return data_->nodal_volumes; }
std::span<const double> Model::nodal_mass() const { return data_->nodal_mass; }
std::span<const double> Model::lumped_mass() const { return data_->lumped_mass; }

double Model::energy(const ConstVectorRef& u) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  std::vector<CompensatedSum>& sums = d.sums;
  std::fill(sums.begin(), sums.end(), CompensatedSum{});
  d.for_each_energy(u.data(), [&](std::size_t thread, const ElementGroup& group, std::size_t batch,
                                  const double* energies) {
    double sum = 0;
    for (int l = 0; l < group.used_lanes(batch); ++l) sum += energies[l];
    sums[thread].add(sum);
  });
  CompensatedSum total;
  for (const CompensatedSum& sum : sums) total.add(sum.value());
  return total.value();
}

void Model::element_energies(const ConstVectorRef& u, std::vector<double>& energies) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  energies.resize(d.num_elements);
  d.for_each_energy(u.data(), [&](std::size_t, const ElementGroup& group, std::size_t batch,
                                  const double* values) {
    const std::int32_t* elements =
        group.elements.data() + batch * static_cast<std::size_t>(group.lanes);
    for (int l = 0; l < group.used_lanes(batch); ++l) {
      energies[static_cast<std::size_t>(elements[l])] = values[l];
    }
  });
}

void Model::forces(const ConstVectorRef& u, VectorRef f) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  d.check_length(f.size(), "the force vector");
  require_kernel(d.groups, &VariantTable<double>::forces, "forces");
  ElementPass pass;
  pass.kernel = &VariantTable<double>::forces;
  pass.displacement = u.data();
  d.add_nodal(pass, f.data());
}

void Model::linearize(const ConstVectorRef& u, TangentForm form) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  d.displacement = u;
  d.form = form;
  d.status = {};
  if (d.has_stiffness()) {
    d.assemble(d.stiffness);
  } else if (d.tangent_product == TangentProduct::two_stage) {
    d.store_states();
  }
}

void Model::product(const ConstVectorRef& v, double scale, VectorRef df) {
  Data& d = *data_;
  d.check_length(v.size(), "the direction");
  d.check_length(df.size(), "the product");
  ElementPass pass;
  pass.direction = v.data();
  pass.scale = scale;
  switch (d.has_stiffness() ? TangentProduct::assembled : d.tangent_product) {
    case TangentProduct::recompute:
      require_kernel(d.groups, &VariantTable<double>::product, "product");
      pass.kernel = &VariantTable<double>::product;
      pass.displacement = d.displacement.data();
      d.add_nodal(pass, df.data());
      break;
    case TangentProduct::two_stage:
      pass.kernel = &VariantTable<double>::apply;
      d.add_nodal(pass, df.data());
      break;
    case TangentProduct::assembled:
      d.status = {};
      d.add_assembled_product(v.data(), scale, df.data());
      break;
  }
}

void Model::assemble(Eigen::SparseMatrix<double>& stiffness) {
  Data& d = *data_;
  if (!d.has_stiffness()) {
    d.assemble(stiffness);
    return;
  }
  d.status = {};
  d.stiffness_assembly().pattern().shape(stiffness);
  std::copy_n(d.stiffness.valuePtr(), d.stiffness.nonZeros(), stiffness.valuePtr());
}

void Model::diagonal_blocks(std::vector<double>& blocks) {
  Data& d = *data_;
  require_kernel(d.groups, &VariantTable<double>::stiffness, "stiffness");
  const int per_node = d.dim * d.dim;
  blocks.assign(d.num_nodes * static_cast<std::size_t>(per_node), 0.0);
  if (d.form == TangentForm::semidefinite) {
    d.status = {};
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k / static_cast<std::size_t>(d.dim));
      const auto column = row / d.dim * d.dim + static_cast<Eigen::Index>(k) % d.dim;
      blocks[k] = d.stiffness.coeff(row, column);
    }
    return;
  }
  ElementPass pass;
  pass.kernel = &VariantTable<double>::stiffness;
  pass.displacement = d.displacement.data();
  d.accumulator->run(
      d.shares, per_node, blocks.data(), [&](int s, std::int32_t node_begin, double* array) {
        const std::size_t thread = static_cast<std::size_t>(s);
        // The kernels overwrite their matrices: nothing to clear beforehand (0 values per node).
        d.statuses[thread] = run_pass(
            d.groups, d.shares[thread], pass, 0, d.workspaces[thread],
            [&](auto layout, const ElementGroup& group, std::size_t batch, const double* matrices) {
              add_diagonal_blocks<decltype(layout)>(group, batch, matrices, node_begin, array);
            });
      });
  d.merge_statuses();
}

std::string Model::describe(const ElementStatus& status) const {
  if (status.ok()) return "every element is good";
  for (const ElementGroup& group : data_->groups) {
    for (std::size_t k = 0; k < group.num_elements; ++k) {
      if (static_cast<std::size_t>(group.elements[k]) != status.element) continue;
      return fmt::format("{}: {}", element_text(group, k), status_text(status.flags));
    }
  }
  throw InternalError(fmt::format("no element {} in the model", status.element));
}

std::vector<GroupSummary> Model::groups() const {
  std::vector<GroupSummary> summaries;
  for (const ElementGroup& group : data_->groups) {
    GroupSummary s;
    s.association = group.table->association;
    s.element = group.table->element;
    s.geometry = group.kernels->geometry;
    s.part = group.part;
    s.num_elements = group.num_elements;
    s.num_batches = group.num_batches;
    s.lanes = group.lanes;
    s.num_constants = group.kernels->num_constants;
    s.num_state = group.state.empty() ? 0 : group.kernels->num_state;
    s.bytes_per_element = group.bytes_per_element();
    summaries.push_back(s);
  }
  return summaries;
}

std::vector<std::int32_t> Model::group_of_elements() const {
  std::vector<std::int32_t> result(data_->num_elements);
  for (std::size_t g = 0; g < data_->groups.size(); ++g) {
    for (const std::int32_t e : data_->groups[g].elements) {
      result[static_cast<std::size_t>(e)] = static_cast<std::int32_t>(g);
    }
  }
  return result;
}

}  // namespace elastogen
