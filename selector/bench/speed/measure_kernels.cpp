#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "runtime/element_group.h"
#include "runtime/rest_geometry.h"
#include "selector/bench/speed/association_kernels.h"
#include "selector/bench/speed/speed_mesh.h"

namespace elastogen::selector {
namespace {

/// One kernel's calls on batches in turn, as passes make them: so few that they stay in the first
/// cache, so many that no operand is in a register.
template <class Scalar>
class KernelCalls {
 public:
  KernelCalls(const Mesh& mesh, const AssociationKernels& kernels, const KernelTable<Scalar>& table,
              const VariantTable<Scalar>& variant)
      : at_once_(static_cast<std::size_t>(variant.batches_at_once)),
        num_batches_(std::max<std::size_t>(2, at_once_)),
        group_(first_batches(mesh, kernels, table, variant)) {
    const std::size_t values = group_.values_per_batch();
    const Vector u = bent(mesh), v = random_direction(mesh);
    displacement_.resize(values * num_batches_);
    direction_.resize(values * num_batches_);
    output_.resize(values * static_cast<std::size_t>(group_.num_nodes * group_.dim));
    flags_.resize(static_cast<std::size_t>(group_.lanes));
    with_layout(group_, [&](auto layout) {
      for (std::size_t b = 0; b < num_batches_; ++b) {
        const std::int32_t* dofs =
            group_.dofs.data() + b * values / static_cast<std::size_t>(group_.dim);
        layout.gather(dofs, group_.num_nodes, u.data(), displacement_.data() + b * values);
        layout.gather(dofs, group_.num_nodes, v.data(), direction_.data() + b * values);
      }
    });
    group_.state.resize(num_batches_ * static_cast<std::size_t>(group_.lanes) *
                        static_cast<std::size_t>(variant.num_state));
  }

  /// Time per element [s].
  Timing time(KernelFunction<Scalar> kernel, double seconds) {
    std::array<KernelArguments<Scalar>, most_batches_at_once> arguments;
    for (std::size_t batch = 0; batch < num_batches_; ++batch) {
      const std::size_t first = batch * group_.values_per_batch();
      arguments[batch] = group_.arguments(batch);
      arguments[batch].displacement = displacement_.data() + first;
      arguments[batch].direction = direction_.data() + first;
      arguments[batch].output = output_.data();
      arguments[batch].status = flags_.data();
    }
    const Timing round = time_calls(1, seconds, [&] {
      for (std::size_t batch = 0; batch < num_batches_; batch += at_once_) {
        kernel(arguments.data() + batch, static_cast<int>(at_once_));
      }
    });
    return round / static_cast<double>(num_batches_) / group_.lanes;
  }

  [[nodiscard]] std::size_t num_batches() const { return num_batches_; }

 private:
  ElementGroup<Scalar> first_batches(const Mesh& mesh, const AssociationKernels& kernels,
                                     const KernelTable<Scalar>& table,
                                     const VariantTable<Scalar>& variant) const {
    std::vector<std::int32_t> elements(num_batches_ * static_cast<std::size_t>(table.lanes));
    std::iota(elements.begin(), elements.end(), 0);
    ElementGroupSource<Scalar> source;
    source.elements = elements;
    source.table = &table;
    source.kernels = &variant;
    source.parameters = kernels.parameters;
    ElementGroup<Scalar> group = make_element_group(mesh, source);
    compute_constants(group, 1);
    return group;
  }

  std::size_t at_once_, num_batches_;
  ElementGroup<Scalar> group_;
  AlignedVector<Scalar> displacement_, direction_, output_;
  AlignedVector<std::uint32_t> flags_;
};

template <class Scalar>
void measure_table(const AssociationKernels& kernels, const KernelTable<Scalar>& table,
                   const SpeedOptions& options, const MachineLimits& limits,
                   const std::function<void(const SpeedRecord&)>& add) {
  struct Entry {
    const char* name;
    KernelFunction<Scalar> VariantTable<Scalar>::*kernel;
  };
  static constexpr Entry entries[] = {
      {"energy", &VariantTable<Scalar>::energy},   {"forces", &VariantTable<Scalar>::forces},
      {"product", &VariantTable<Scalar>::product}, {"linearize", &VariantTable<Scalar>::linearize},
      {"apply", &VariantTable<Scalar>::apply},     {"stiffness", &VariantTable<Scalar>::stiffness}};
  // Enough elements for four batches of floats, whatever cells are cut into; boxes are affine, too.
  const Mesh mesh = make_speed_mesh(kernels.id, 256, false);
  for (std::int32_t v = 0; v < table.num_variants; ++v) {
    const VariantTable<Scalar>& variant = table.variants[v];
    KernelCalls<Scalar> calls(mesh, kernels, table, variant);
    for (const Entry& entry : entries) {
      if (options.interrupted()) return;
      const symgen::OperationReport& report = kernels.report(variant.geometry, entry.name);
      if (report.flops == 0) continue;
      const Timing time = calls.time(variant.*entry.kernel, options.seconds);
      SpeedRecord record;
      record.benchmark = "kernels";
      record.association = kernels.id.text();
      record.geometry = variant.geometry;
      record.precision = sizeof(Scalar) == 8 ? "double" : "single";
      record.operation = entry.name;
      record.elements = calls.num_batches() * static_cast<std::size_t>(table.lanes);
      record.minimum = 1e9 * time.minimum;
      record.median = 1e9 * time.median;
      record.flops = static_cast<double>(report.flops);
      record.bytes = static_cast<double>(report.bytes_read + report.bytes_written) *
                     sizeof(Scalar) / sizeof(double);
      record.of_peak = record.flops / record.minimum / limits.peak(sizeof(Scalar) == 4, 1);
      record.of_roofline = record.of_peak;
      add(record);
    }
  }
}

}  // namespace

void measure_kernels(const SpeedOptions& options, const MachineLimits& limits,
                     const std::function<void(const SpeedRecord&)>& add) {
  for (const symgen::AssociationId& id : options.associations) {
    const AssociationKernels kernels = load_kernels(id, options);
    for (const std::string& precision : options.precisions) {
      if (options.interrupted()) return;
      options.tell(fmt::format("kernels of {} in {}", id.text(), precision));
      if (precision == "double") {
        measure_table(kernels, kernels.in_double.table<double>(), options, limits, add);
      } else {
        measure_table(kernels, kernels.in_single.table<float>(), options, limits, add);
      }
    }
  }
}

}  // namespace elastogen::selector
