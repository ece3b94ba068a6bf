#include "runtime/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "runtime/cheaper_product.h"
#include "runtime/element_group.h"
#include "runtime/element_system.h"
#include "runtime/error.h"
#include "runtime/mesh_order.h"
#include "runtime/model_parts.h"
#include "runtime/rest_geometry.h"
#include "runtime/stress_pass.h"

namespace elastogen {
namespace {

const char* status_text(std::uint32_t flags) {
  if ((flags & status_outside_domain) != 0) {
    return "its deformation is outside the domain of its law (turned inside out, flattened, or "
           "where "
           "the law has no derivative)";
  }
  return "its result is not finite";
}

template <class Scalar>
const ElementGroup<Scalar>* find_element(const std::vector<ElementGroup<Scalar>>& groups,
                                         std::size_t element, std::size_t& k) {
  for (const ElementGroup<Scalar>& group : groups) {
    for (k = 0; k < group.num_elements; ++k) {
      if (static_cast<std::size_t>(group.elements[k]) == element) return &group;
    }
  }
  return nullptr;
}

template <class Scalar>
GroupSummary summary_of(const ElementGroup<Scalar>& group) {
  GroupSummary s;
  s.association = group.table->association;
  s.element = group.table->element;
  s.geometry = group.kernels->geometry;
  s.scalar = std::is_same_v<Scalar, double> ? "double" : "float";
  s.instruction_set = group.table->instruction_set;
  s.part = group.part;
  s.at_rest = group.at_rest;
  s.num_elements = group.num_elements;
  s.num_batches = group.num_batches;
  s.lanes = group.lanes;
  s.num_constants = group.kernels->num_constants;
  s.num_state = group.state.empty() ? 0 : group.kernels->num_state;
  s.num_shapes = group.shape.empty() ? group.num_elements : group.num_sets;
  s.bytes_per_element = group.bytes_per_element();
  return s;
}

// In four sums, as each addition waits for the one before it.
double inner_product(const double* a, const double* b, int count) {
  double sums[4] = {};
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    for (int i = 0; i < 4; ++i) sums[i] += a[k + i] * b[k + i];
  }
  for (; k < count; ++k) sums[0] += a[k] * b[k];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// df -= scale * K v. The columns of a node have the same rows: values of v are gathered once for
// all of them, and what is left are products of contiguous numbers. K is symmetric, so a row is a
// column, and every value is written by one thread.
template <int dim>
void subtract_product(const Eigen::SparseMatrix<double>& stiffness, const double* v, double scale,
                      double* df, int threads) {
  constexpr int chunk = 32 * dim;  // rows that are gathered together
  const int* const outer = stiffness.outerIndexPtr();
  const Eigen::Index num_nodes = stiffness.rows() / dim;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (Eigen::Index node = 0; node < num_nodes; ++node) {
    const int length = outer[dim * node + 1] - outer[dim * node];
    const int* const rows = stiffness.innerIndexPtr() + outer[dim * node];
    const double* const columns = stiffness.valuePtr() + outer[dim * node];
    std::array<double, dim> sums{};
    for (int begin = 0; begin < length; begin += chunk) {
      const int count = std::min(chunk, length - begin);
      double gathered[chunk];
      for (int k = 0; k < count; k += dim) {
        for (int i = 0; i < dim; ++i) gathered[k + i] = v[rows[begin + k] + i];
      }
      for (int j = 0; j < dim; ++j) {
        sums[j] += inner_product(columns + j * length + begin, gathered, count);
      }
    }
    for (int j = 0; j < dim; ++j) df[dim * node + j] -= scale * sums[j];
  }
}

}  // namespace

std::string_view precision_name(Precision precision) {
  constexpr std::array<std::string_view, 3> names = {"double", "mixed", "single"};
  return names[static_cast<std::size_t>(precision)];
}

std::string_view tangent_product_name(TangentProduct product) {
  constexpr std::array<std::string_view, 4> names = {"recompute", "two-stage", "assembled", "auto"};
  return names[static_cast<std::size_t>(product)];
}

struct Model::Data {
  int dim = 3;
  std::size_t num_nodes = 0;
  std::size_t num_elements = 0;
  ModelOptions options;
  int threads = 1;
  bool reordered = false;
  std::optional<ElementSystem<double>> in_double;  // unless single precision
  std::optional<ElementSystem<float>> in_single;   // unless double precision
  Eigen::SparseMatrix<double> stiffness;           // where has_stiffness()
  TangentForm form = TangentForm::exact;
  std::vector<double> positions;         // of the mesh at rest: what stress() is given
  std::vector<std::size_t> first_point;  // StressField::first
  std::vector<double> element_volumes, nodal_volumes, nodal_mass, lumped_mass;
  ElementStatus status;

  [[nodiscard]] std::size_t num_dofs() const { return static_cast<std::size_t>(dim) * num_nodes; }

  void check_length(Eigen::Index length, const char* what) const {
    if (static_cast<std::size_t>(length) == num_dofs()) return;
    throw InternalError(fmt::format("{} has {} values, the model has {} degrees of freedom", what,
                                    length, num_dofs()));
  }

  // Calls `function` with the elements that give energies and forces, or those of the tangent.
  template <class Function>
  auto with_forces(Function&& function) {
    return in_double ? function(*in_double) : function(*in_single);
  }
  template <class Function>
  auto with_tangent(Function&& function) {
    return in_single ? function(*in_single) : function(*in_double);
  }

  template <class Scalar>
  void make_system(std::optional<ElementSystem<Scalar>>& system,
                   std::vector<ElementGroup<Scalar>> groups, bool has_tangent) {
    if (has_tangent && options.tangent_product == TangentProduct::automatic) {
      options.tangent_product = cheaper_product(groups, options.products_per_tangent);
    }
    const bool two_stage = has_tangent && options.tangent_product == TangentProduct::two_stage;
    system.emplace(std::move(groups), num_nodes, dim, threads, two_stage, reordered);
    threads = system->num_threads();
  }

  // Whether products are those of the assembled stiffness.
  [[nodiscard]] bool has_stiffness() const {
    return form == TangentForm::semidefinite ||
           options.tangent_product == TangentProduct::assembled;
  }

  void assemble(Eigen::SparseMatrix<double>& matrix) {
    status = with_tangent([&](auto& elements) { return elements.assemble(form, matrix); });
  }

  void add_assembled_product(const double* v, double scale, double* df) const {
    if (dim == 3) {
      subtract_product<3>(stiffness, v, scale, df, threads);
    } else {
      subtract_product<2>(stiffness, v, scale, df, threads);
    }
  }
};

Model::Model(const Mesh& mesh, std::span<const ModelPart> given_parts, const ModelOptions& options)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.options = options;
  d.threads = options.threads;
  const bool mixed = options.precision == Precision::mixed;
  check_parts(mesh, given_parts, options);
  d.reordered = options.reorder && is_scattered(mesh, given_parts);
  std::vector<ModelPart> parts_along_curve;
  std::span<const ModelPart> parts = given_parts;
  if (d.reordered || options.sleep.motion > 0) {
    parts_along_curve = along_curve(mesh, given_parts);
    parts = parts_along_curve;
  }
  std::vector<ElementGroup<double>> groups = make_element_groups<double>(mesh, parts, options);
  d.dim = mesh.dim;
  d.num_nodes = mesh.num_nodes();
  d.num_elements = mesh.num_elements();
  d.positions = mesh.positions;
  d.nodal_volumes.assign(d.num_nodes, 0.0);
  d.nodal_mass.assign(d.num_nodes, 0.0);
  d.lumped_mass.assign(d.num_nodes, 0.0);
  d.element_volumes.assign(d.num_elements, 0.0);
  std::vector<std::int32_t> element_points(d.num_elements);
  for (const ElementGroup<double>& group : groups) {
    measure_rest_shapes(group, mesh,
                        {d.nodal_volumes, d.nodal_mass, d.lumped_mass, d.element_volumes});
    for (const std::int32_t e : group.elements) {
      element_points[static_cast<std::size_t>(e)] = group.table->num_points;
    }
  }
  d.first_point = first_points(element_points);
  if (options.precision != Precision::single_precision) {
    d.make_system(d.in_double, std::move(groups), !mixed);
  }
  if (options.precision != Precision::double_precision) {
    d.make_system(d.in_single, make_element_groups<float>(mesh, parts, options), true);
  }
  if (options.tangent_product != TangentProduct::recompute) {
    linearize(Vector::Zero(static_cast<Eigen::Index>(d.num_dofs())));
  }
}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

int Model::dim() const { return data_->dim; }
std::size_t Model::num_nodes() const { return data_->num_nodes; }
std::size_t Model::num_dofs() const { return data_->num_dofs(); }
std::size_t Model::num_elements() const { return data_->num_elements; }
int Model::num_threads() const { return data_->threads; }
TangentProduct Model::tangent_product() const { return data_->options.tangent_product; }
Precision Model::precision() const { return data_->options.precision; }
bool Model::is_reordered() const { return data_->reordered; }
const ElementStatus& Model::status() const { return data_->status; }
std::span<const double> Model::element_volumes() const { return data_->element_volumes; }
std::span<const double> Model::nodal_volumes() const { return data_->nodal_volumes; }
std::span<const double> Model::nodal_mass() const { return data_->nodal_mass; }
std::span<const double> Model::lumped_mass() const { return data_->lumped_mass; }

double Model::epsilon() const {
  return precision() == Precision::single_precision ? std::numeric_limits<float>::epsilon()
                                                    : std::numeric_limits<double>::epsilon();
}

double Model::energy(const ConstVectorRef& u) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  double energy = 0;
  d.status = d.with_forces([&](auto& elements) { return elements.energy(u.data(), energy); });
  return energy;
}

void Model::element_energies(const ConstVectorRef& u, std::vector<double>& energies) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  energies.assign(d.num_elements, 0.0);
  d.status = d.with_forces(
      [&](auto& elements) { return elements.element_energies(u.data(), energies.data()); });
}

void Model::stress(const ConstVectorRef& u, StressField& field) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  field.first = d.first_point;
  field.points.resize(d.first_point.back());
  d.status = d.with_forces(
      [&](auto& elements) { return compute_stress(elements, d.positions, u.data(), field); });
}

void Model::forces(const ConstVectorRef& u, VectorRef f) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  d.check_length(f.size(), "the force vector");
  d.status = d.with_forces([&](auto& elements) { return elements.forces(u.data(), f.data()); });
}

void Model::let_sleep(bool allowed) {
  const SleepOptions& sleep = data_->options.sleep;
  data_->with_forces([&](auto& elements) {
    if (allowed && sleep.motion > 0) {
      elements.let_sleep(sleep.motion, sleep.calls);
    } else {
      elements.wake();
    }
  });
}

void Model::linearize(const ConstVectorRef& u, TangentForm form) {
  Data& d = *data_;
  d.check_length(u.size(), "the displacement");
  d.form = form;
  d.status = {};
  d.with_tangent([&](auto& elements) { elements.set_point(u.data()); });
  if (d.has_stiffness()) {
    d.assemble(d.stiffness);
  } else if (tangent_product() == TangentProduct::two_stage) {
    d.status = d.with_tangent([](auto& elements) { return elements.store_states(); });
  }
}

void Model::product(const ConstVectorRef& v, double scale, VectorRef df) {
  Data& d = *data_;
  d.check_length(v.size(), "the direction");
  d.check_length(df.size(), "the product");
  switch (d.has_stiffness() ? TangentProduct::assembled : tangent_product()) {
    case TangentProduct::recompute:
      d.status = d.with_tangent(
          [&](auto& elements) { return elements.product(v.data(), scale, df.data()); });
      break;
    case TangentProduct::two_stage:
      d.status = d.with_tangent(
          [&](auto& elements) { return elements.apply(v.data(), scale, df.data()); });
      break;
    case TangentProduct::automatic:  // has become one of the others
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
  d.with_tangent([&](auto& elements) { elements.shape(stiffness); });
  std::copy_n(d.stiffness.valuePtr(), d.stiffness.nonZeros(), stiffness.valuePtr());
}

void Model::diagonal_blocks(std::vector<double>& blocks) {
  Data& d = *data_;
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
  d.status =
      d.with_tangent([&](auto& elements) { return elements.diagonal_blocks(blocks.data()); });
}

std::string Model::describe(const ElementStatus& status) const {
  if (status.ok()) return "every element is good";
  return data_->with_forces([&](auto& elements) {
    std::size_t k = 0;
    const auto* group = find_element(elements.groups(), status.element, k);
    if (!group) throw InternalError(fmt::format("no element {} in the model", status.element));
    return fmt::format("{}: {}", element_text(*group, elements.numbering(), k),
                       status_text(status.flags));
  });
}

SkippedWork Model::skipped() const {
  SkippedWork work;
  double seconds = 0;
  std::int64_t at_rest = 0;  // element passes
  const auto add = [&](const auto& elements) {
    if (!elements) return;
    std::size_t resting = 0;
    for (const auto& group : elements->groups()) resting += group.at_rest ? group.num_elements : 0;
    const PassCounts& counts = elements->counts();
    work.elements_at_rest = resting;
    work.element_passes += counts.passes * static_cast<std::int64_t>(num_elements());
    work.slept += counts.slept;
    work.seconds_saved -= counts.seconds_of_sleep;
    at_rest += counts.passes * static_cast<std::int64_t>(resting);
    seconds += counts.seconds;
  };
  add(data_->in_double);
  add(data_->in_single);
  const std::int64_t computed = work.element_passes - at_rest - work.slept;
  if (computed > 0) {
    work.seconds_saved +=
        seconds * static_cast<double>(at_rest + work.slept) / static_cast<double>(computed);
  }
  return work;
}

std::vector<GroupSummary> Model::groups() const {
  std::vector<GroupSummary> summaries;
  const auto add = [&](const auto& elements) {
    if (!elements) return;
    for (const auto& group : elements->groups()) summaries.push_back(summary_of(group));
  };
  add(data_->in_double);
  add(data_->in_single);
  return summaries;
}

std::vector<std::int32_t> Model::group_of_elements() const {
  std::vector<std::int32_t> result(data_->num_elements);
  data_->with_forces([&](auto& elements) {
    for (std::size_t g = 0; g < elements.groups().size(); ++g) {
      for (const std::int32_t e : elements.groups()[g].elements) {
        result[static_cast<std::size_t>(e)] = static_cast<std::int32_t>(g);
      }
    }
  });
  return result;
}

}  // namespace elastogen
