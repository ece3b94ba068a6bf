// What generated kernels are written with beside kernel_functions.h: roots, and the step from the
// ABI's plain arrays to packs. Included by generated code only.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "runtime/kernel_abi.h"
#include "runtime/kernel_functions.h"

namespace elastogen::kernel {

template <class V>
inline constexpr int lanes_of = static_cast<int>(sizeof(V) / sizeof(Scalar<V>));

/// Inputs of a kernel as packs; see KernelArguments.
template <class V>
struct Inputs {
  const V* x;          ///< rest positions
  const Scalar<V>* p;  ///< parameters
  const V* c;          ///< grouped constants
  const V* u;          ///< displacement
  const V* v;          ///< direction
  const V* s;          ///< state of the two-stage product
};

/// f of every lane.
template <class V, class F>
inline V map(const V& x, const F& f) {
  if constexpr (std::is_floating_point_v<V>) {
    return f(x);
  } else {
    V result;
    for (int l = 0; l < lanes_of<V>; ++l) result[l] = f(x[l]);
    return result;
  }
}

/// x^(1/q), q >= 2; for x > 0.
template <class V>
inline V root(const V& x, int q) {
  return map(x, [q](Scalar<V> a) {
    if (q == 2) return std::sqrt(a);
    if (q == 3) return std::cbrt(a);
    return std::pow(a, Scalar<V>(1) / Scalar<V>(q));
  });
}

/// Lanes of `margin` become the smaller of the two; a kernel's margin ends positive where the law
/// is defined.
template <class V>
inline void keep_smaller(V& margin, const V& x) {
  margin = x < margin ? x : margin;
}

template <class V>
inline Scalar<V> lane(const V& x, [[maybe_unused]] int l) {
  if constexpr (std::is_floating_point_v<V>) {
    return x;
  } else {
    return x[l];
  }
}

/// Or-s the status bits of every lane: `margin` must be positive, `residue` zero.
template <class V>
inline void report_status(const V& margin, const V& residue, std::uint32_t* status) {
  for (int l = 0; l < lanes_of<V>; ++l) {
    if (!(lane(margin, l) > Scalar<V>(0))) status[l] |= status_outside_domain;
    if (!(lane(residue, l) == Scalar<V>(0))) status[l] |= status_not_finite;
  }
}

/// How a kernel's results reach KernelArguments::output.
enum class Write { overwrite, accumulate, accumulate_scaled };

/// A kernel of the ABI from a kernel template: `compute(in, out, margin)` fills num_outputs packs.
/// An output times zero is zero unless it is infinite or not a number: so the status is found
/// without branches.
template <class V, int num_outputs, Write write, class Compute>
inline void run(const KernelArguments<Scalar<V>>& arguments, const Compute& compute) {
  const auto packs = [](const Scalar<V>* data) { return reinterpret_cast<const V*>(data); };
  const Inputs<V> in{packs(arguments.positions), arguments.parameters,
                     packs(arguments.constants), packs(arguments.displacement),
                     packs(arguments.direction), packs(arguments.state)};
  V* const output = reinterpret_cast<V*>(arguments.output);
  V margin = V{} + Scalar<V>(1);
  V residue = V{};
  if constexpr (write == Write::overwrite) {
    compute(in, output, margin);
    for (int k = 0; k < num_outputs; ++k) residue += output[k] * Scalar<V>(0);
  } else {
    V result[num_outputs];
    compute(in, result, margin);
    for (int k = 0; k < num_outputs; ++k) {
      residue += result[k] * Scalar<V>(0);
      if constexpr (write == Write::accumulate_scaled) {
        output[k] += arguments.scale * result[k];
      } else {
        output[k] += result[k];
      }
    }
  }
  if (arguments.status != nullptr) report_status(margin, residue, arguments.status);
}

}  // namespace elastogen::kernel
