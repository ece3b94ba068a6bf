#include "selector/commands/evaluation.h"

#include <fmt/format.h>

#include <cstring>

#include "runtime/aligned_vector.h"
#include "runtime/error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

template <class Scalar>
const VariantTable<Scalar>& variant_of(const KernelTable<Scalar>& table,
                                       const std::string& geometry) {
  std::vector<std::string> names;
  for (int v = 0; v < table.num_variants; ++v) {
    if (geometry == table.variants[v].geometry) return table.variants[v];
    names.emplace_back(table.variants[v].geometry);
  }
  throw InputError(fmt::format("'{}' has no geometry variant '{}' (it has: {})", table.association,
                               geometry, join(names, ", ")));
}

/// Buffers of a batch that holds the same element in every lane.
template <class Scalar>
class Batch {
 public:
  Batch(const KernelTable<Scalar>& table, const VariantTable<Scalar>& variant,
        const symgen::ElementCase& input)
      : lanes_(static_cast<std::size_t>(table.lanes)),
        positions_(spread(input.rest_positions)),
        parameters_(input.parameters.begin(), input.parameters.end()),
        constants_(static_cast<std::size_t>(variant.num_constants) * lanes_),
        displacement_(spread(input.displacement)),
        direction_(spread(input.direction)),
        status_(lanes_, status_ok) {
    const KernelArguments<Scalar> batch = arguments(constants_.data());
    variant.constants(&batch, 1);
  }

  /// Calls a kernel with `count` outputs per element.
  [[nodiscard]] std::vector<double> call(KernelFunction<Scalar> kernel, std::size_t count) {
    AlignedVector<Scalar> output(count * lanes_, Scalar(0));
    const KernelArguments<Scalar> batch = arguments(output.data());
    kernel(&batch, 1);
    std::vector<double> result;
    for (std::size_t k = 0; k < count; ++k) {
      const Scalar* lane = output.data() + k * lanes_;
      for (std::size_t l = 1; l < lanes_; ++l) {
        // Bits, not values: NaN in every lane is agreement.
        if (std::memcmp(lane, lane + l, sizeof(Scalar)) != 0) {
          throw InternalError(fmt::format("lanes 0 and {} computed different values", l));
        }
      }
      result.push_back(static_cast<double>(lane[0]));
    }
    return result;
  }

  [[nodiscard]] std::uint32_t status() const { return status_.front(); }

 private:
  [[nodiscard]] AlignedVector<Scalar> spread(const std::vector<double>& values) const {
    AlignedVector<Scalar> result;
    for (const double value : values) {
      result.insert(result.end(), lanes_, static_cast<Scalar>(value));
    }
    return result;
  }

  [[nodiscard]] KernelArguments<Scalar> arguments(Scalar* output) {
    KernelArguments<Scalar> arguments;
    arguments.positions = positions_.data();
    arguments.parameters = parameters_.data();
    arguments.constants = constants_.data();
    arguments.displacement = displacement_.data();
    arguments.direction = direction_.data();
    arguments.output = output;
    arguments.status = status_.data();
    return arguments;
  }

  std::size_t lanes_;
  AlignedVector<Scalar> positions_, parameters_, constants_, displacement_, direction_;
  AlignedVector<std::uint32_t> status_;
};

}  // namespace

template <class Scalar>
KernelEvaluation evaluate_kernels(const KernelTable<Scalar>& table, const std::string& geometry,
                                  const symgen::ElementCase& input) {
  const VariantTable<Scalar>& variant = variant_of(table, geometry);
  const std::size_t size = input.displacement.size();
  Batch<Scalar> batch(table, variant, input);
  KernelEvaluation result;
  result.energy = batch.call(variant.energy, 1).front();
  result.forces = batch.call(variant.forces, size);
  if (!input.direction.empty()) result.product = batch.call(variant.product, size);
  result.stiffness = batch.call(variant.stiffness, size * size);
  result.stress =
      batch.call(variant.stress, static_cast<std::size_t>(stress_numbers * table.num_points));
  result.status = batch.status();
  return result;
}

template KernelEvaluation evaluate_kernels(const KernelTable<float>&, const std::string&,
                                           const symgen::ElementCase&);
template KernelEvaluation evaluate_kernels(const KernelTable<double>&, const std::string&,
                                           const symgen::ElementCase&);

std::string status_text(std::uint32_t status) {
  std::string text;
  if ((status & status_outside_domain) != 0) {
    text = "outside the law's domain: the argument of a logarithm or root is not positive";
  }
  if ((status & status_not_finite) != 0) {
    text += text.empty() ? "" : "; ";
    text += "not finite: a result is NaN or infinite";
  }
  return text.empty() ? "ok" : text;
}

}  // namespace elastogen::selector
