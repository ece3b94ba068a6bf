#include "selector/bench/speed/operator_speed.h"

#include <algorithm>

#include "selector/bench/speed/speed_mesh.h"

namespace elastogen::selector {
namespace {

TangentProduct strategy_named(const std::string& name) {
  for (const auto product : {TangentProduct::two_stage, TangentProduct::assembled}) {
    if (name == tangent_product_name(product)) return product;
  }
  return TangentProduct::recompute;
}

}  // namespace

SpeedRecord record_on_mesh(const std::string& benchmark, const AssociationKernels& kernels,
                           const Mesh& mesh, const std::string& shape) {
  SpeedRecord record;
  record.benchmark = benchmark;
  record.association = kernels.id.text();
  record.precision = "double";
  record.mesh = shape;
  record.elements = mesh.num_elements();
  record.dofs = mesh.positions.size();
  return record;
}

OperatorSpeed::OperatorSpeed(const AssociationKernels& kernels, const Mesh& mesh,
                             SpeedRecord record, const SpeedOptions& options,
                             const MachineLimits& limits,
                             const std::function<void(const SpeedRecord&)>& add)
    : kernels_(kernels),
      mesh_(mesh),
      start_(std::move(record)),
      options_(options),
      limits_(limits),
      add_(add),
      u_(bent(mesh)),
      v_(random_direction(mesh)),
      f_(Vector::Zero(u_.size())) {}

Model OperatorSpeed::make_model(TangentProduct product) const {
  ModelPart part;
  for (std::size_t e = 0; e < mesh_.num_elements(); ++e) {
    part.elements.push_back(static_cast<std::int32_t>(e));
  }
  part.kernels = &kernels_.in_double.table<double>();
  part.parameters = kernels_.parameters;
  part.density = 1000;
  ModelOptions options;
  options.threads = start_.threads;
  options.tangent_product = product;
  options.reorder = start_.order != "random";
  if (start_.precision == "single") {
    part.single_kernels = &kernels_.in_single.table<float>();
    options.precision = Precision::single_precision;
  }
  return Model(mesh_, std::span(&part, 1), options);
}

template <class Function>
void OperatorSpeed::time(Model& model, const std::string& operation, const std::string& strategy,
                         Function&& function) {
  if (options_.interrupted()) return;
  const double elements = static_cast<double>(mesh_.num_elements());
  const Timing timing = time_calls(start_.threads, options_.seconds, function) / elements;
  SpeedRecord record = start_;
  record.operation = operation;
  record.strategy = strategy;
  record.minimum = 1e9 * timing.minimum;
  record.median = 1e9 * timing.median;
  count(model, record);
  const double least =
      std::max(record.flops / limits_.peak(record.precision == "single", record.threads),
               record.bytes / limits_.bandwidth(record.bytes * elements, record.threads));
  record.of_peak =
      record.flops / record.minimum / limits_.peak(record.precision == "single", record.threads);
  record.of_roofline = least / record.minimum;
  add_(record);
}

void OperatorSpeed::measure_forces() {
  Model model = make_model(TangentProduct::recompute);
  time(model, "forces", "", [&] {
    f_.setZero();
    model.forces(u_, f_);
  });
}

void OperatorSpeed::measure_energy() {
  Model model = make_model(TangentProduct::recompute);
  time(model, "energy", "", [&] { energy_ += model.energy(u_); });
}

void OperatorSpeed::measure_products(const std::string& strategy) {
  Model model = make_model(strategy_named(strategy));
  if (strategy != "recompute") time(model, "rebuild", strategy, [&] { model.linearize(u_); });
  model.linearize(u_);
  time(model, "product", strategy, [&] {
    f_.setZero();
    model.product(v_, 1, f_);
  });
}

/// Flops and bytes per element, over the model's groups.
void OperatorSpeed::count(Model& model, SpeedRecord& record) {
  const double elements = static_cast<double>(mesh_.num_elements());
  const double values = static_cast<double>(mesh_.positions.size()) / elements;
  const double of_vector = 8 * values;
  const bool is_matrix = record.strategy == "assembled";
  const double entries = is_matrix ? num_entries(model) / elements : 0;
  const char* kernel = record.operation.c_str();
  if (record.operation == "rebuild") kernel = is_matrix ? "stiffness" : "linearize";
  if (record.operation == "product" && record.strategy == "two-stage") kernel = "apply";
  std::string geometry;
  for (const GroupSummary& group : model.groups()) {
    const double share = static_cast<double>(group.num_elements) / elements;
    record.flops += share * static_cast<double>(kernels_.report(group.geometry, kernel).flops);
    record.stored += share * static_cast<double>(group.bytes_per_element);
    if (geometry.find(group.geometry) == std::string::npos) {
      geometry += (geometry.empty() ? "" : "+") + group.geometry;
    }
  }
  record.geometry = geometry;
  record.bytes = record.stored + of_vector;                         // the displacement is read
  if (record.operation == "forces") record.bytes += 2 * of_vector;  // read and written
  if (record.operation == "product") record.bytes += 3 * of_vector;
  if (!is_matrix) return;
  // A number and its column for each entry.
  record.stored += 12 * entries;
  if (record.operation == "rebuild") {
    record.bytes += 8 * entries;
  } else {
    record.flops = 2 * entries;
    record.bytes = 12 * entries + 3 * of_vector;
  }
}

double OperatorSpeed::num_entries(Model& model) {
  if (num_entries_ == 0) {
    Eigen::SparseMatrix<double> stiffness;
    model.assemble(stiffness);
    num_entries_ = static_cast<double>(stiffness.nonZeros());
  }
  return num_entries_;
}

}  // namespace elastogen::selector
