// What generated kernels are written with beside kernel_functions.h: roots, and the step from the
// ABI's plain arrays to packs. Included by generated code only.
#pragma once

#include <cstdint>
#include <type_traits>

#include "runtime/kernel_abi.h"
#include "runtime/kernel_functions.h"
#include "runtime/kernel_instruction_set.h"
#include "runtime/nodal_pass.h"

namespace elastogen::kernel {
inline namespace ELASTOGEN_INSTRUCTION_SET {

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
inline double scalar_root(double x, int q) {
  if (q == 2) return __builtin_sqrt(x);
  if (q == 3) return __builtin_cbrt(x);
  return __builtin_pow(x, 1 / static_cast<double>(q));
}
inline float scalar_root(float x, int q) {
  if (q == 2) return __builtin_sqrtf(x);
  if (q == 3) return __builtin_cbrtf(x);
  return __builtin_powf(x, 1 / static_cast<float>(q));
}
template <class V>
inline V root(const V& x, int q) {
  return map(x, [q](Scalar<V> a) { return scalar_root(a, q); });
}

/// Lanes of `margin` become the smaller of the two; a kernel's margin ends positive where the law
/// is defined.
template <class V>
inline void keep_smaller(V& margin, const V& x) {
  margin = x < margin ? x : margin;
}

/// Or-s the status bits of every lane: `margin` must be positive, `residue` zero.
template <class V>
inline void report_status(const V& margin, const V& residue, std::uint32_t* status) {
  if constexpr (std::is_floating_point_v<V>) {
    if (!(margin > V(0))) *status |= status_outside_domain;
    if (!(residue == V(0))) *status |= status_not_finite;
  } else {
    using I = Integer<V>;
    const I outside = I{} + Integer<Scalar<V>>(status_outside_domain);
    const I not_finite = I{} + Integer<Scalar<V>>(status_not_finite);
    const I flags =
        (margin > Scalar<V>(0) ? I{} : outside) | (residue == Scalar<V>(0) ? I{} : not_finite);
    for (int l = 0; l < lanes_of<V>; ++l) status[l] |= static_cast<std::uint32_t>(flags[l]);
  }
}

/// Sums outputs times zero: zero unless one is infinite or not a number, found without branches. In
/// four sums, as each addition waits for the one before it.
template <class V>
struct Residue {
  void add(int k, const V& output) { parts[k % 4] += output * Scalar<V>(0); }
  [[nodiscard]] V sum() const { return (parts[0] + parts[1]) + (parts[2] + parts[3]); }
  V parts[4] = {};
};

/// A kernel of the ABI from a kernel template: `compute(in, out, margin)` fills num_outputs packs.
template <class V, int num_outputs, class Compute>
inline void run(const KernelArguments<Scalar<V>>& arguments, const Compute& compute) {
  const auto packs = [](const Scalar<V>* data) { return reinterpret_cast<const V*>(data); };
  const Inputs<V> in{packs(arguments.positions), arguments.parameters,
                     packs(arguments.constants), packs(arguments.displacement),
                     packs(arguments.direction), packs(arguments.state)};
  V* const output = reinterpret_cast<V*>(arguments.output);
  V margin = V{} + Scalar<V>(1);
  Residue<V> residue;
  // Few results stay in registers, which no input can alias.
  constexpr int most_in_registers = 64;
  if constexpr (num_outputs > most_in_registers) {
    compute(in, output, margin);
    for (int k = 0; k < num_outputs; ++k) residue.add(k, output[k]);
  } else if constexpr (num_outputs > 0) {
    V result[num_outputs];
    compute(in, result, margin);
    for (int k = 0; k < num_outputs; ++k) {
      residue.add(k, result[k]);
      output[k] = result[k];
    }
  }
  if (arguments.status != nullptr) report_status(margin, residue.sum(), arguments.status);
}

}  // namespace ELASTOGEN_INSTRUCTION_SET
}  // namespace elastogen::kernel
