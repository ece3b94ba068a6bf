#include "runtime/cheaper_product.h"

namespace elastogen {
namespace {

/// Reading or writing a number of state, in additions: from the last cache, and from memory. It
/// streams, so processors fetch it ahead: a core of Zen 3 reads 8 bytes in 0.5 ns from memory, in
/// which a kernel does 12 operations.
constexpr double price_in_cache = 3, price_in_memory = 12;
/// What the last cache of a current processor holds for one program [B].
constexpr double cache_bytes = 16 * 1024 * 1024;

}  // namespace

template <class Scalar>
TangentProduct cheaper_product(const std::vector<ElementGroup<Scalar>>& groups,
                               double products_per_tangent) {
  double saved = 0, once = 0, states = 0, bytes = 0;
  for (const ElementGroup<Scalar>& group : groups) {
    if (group.at_rest) continue;
    const VariantTable<Scalar>& kernels = *group.kernels;
    if (kernels.linearize == nullptr || kernels.apply == nullptr) return TangentProduct::recompute;
    if (kernels.product == nullptr) return TangentProduct::two_stage;
    const double count = static_cast<double>(group.num_elements);
    saved += count * (kernels.costs.product - kernels.costs.apply);
    once += count * kernels.costs.linearize;
    states += count * kernels.num_state;
    bytes += count * static_cast<double>(group.bytes_per_element());
  }
  bytes += states * sizeof(Scalar);
  const double price = states * (bytes < cache_bytes ? price_in_cache : price_in_memory);
  const bool pays = products_per_tangent * (saved - price) > once + price;
  return pays ? TangentProduct::two_stage : TangentProduct::recompute;
}

template TangentProduct cheaper_product(const std::vector<ElementGroup<double>>&, double);
template TangentProduct cheaper_product(const std::vector<ElementGroup<float>>&, double);

}  // namespace elastogen
