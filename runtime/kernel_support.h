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

/// The sum of outputs times zero: zero unless one is infinite or not a number (or all are so great
/// that their sum is), found without branches and by additions, for which units are free where
/// kernels multiply. In four sums, as each addition waits for the one before it.
template <class V>
struct Residue {
  void add(int k, const V& output) { parts[k % 4] += output; }
  [[nodiscard]] V sum() const {
    return ((parts[0] + parts[1]) + (parts[2] + parts[3])) * Scalar<V>(0);
  }
  V parts[4] = {};
};

/// Inputs of a batch.
template <class V>
inline Inputs<V> inputs_of(const KernelArguments<Scalar<V>>& batch) {
  const auto packs = [](const Scalar<V>* data) { return reinterpret_cast<const V*>(data); };
  return {packs(batch.positions),    batch.parameters,       packs(batch.constants),
          packs(batch.displacement), packs(batch.direction), packs(batch.state)};
}

/// Writes a batch's num_outputs packs, which `compute(out)` fills, and its status.
template <class V, int num_outputs, class Compute>
inline void write(const KernelArguments<Scalar<V>>& batch, const V& margin,
                  const Compute& compute) {
  V* const output = reinterpret_cast<V*>(batch.output);
  Residue<V> residue;
  // Few results stay in registers, which no input can alias.
  constexpr int most_in_registers = 64;
  if constexpr (num_outputs > most_in_registers) {
    compute(output);
    for (int k = 0; k < num_outputs; ++k) residue.add(k, output[k]);
  } else if constexpr (num_outputs > 0) {
    V result[num_outputs];
    compute(result);
    for (int k = 0; k < num_outputs; ++k) {
      residue.add(k, result[k]);
      output[k] = result[k];
    }
  }
  if (batch.status != nullptr) report_status(margin, residue.sum(), batch.status);
}

/// Of an operation that is one step.
struct NoSteps {
  static constexpr int num_carried = 0;
};

/// A kernel of the ABI from a kernel template, `compute(in, out, margin)` of one batch, or from its
/// steps, each of which all batches take before the next.
template <class V, int num_outputs, class Steps, class Compute>
inline void run(const KernelArguments<Scalar<V>>* batches, int count,
                [[maybe_unused]] const Compute& compute) {
  if constexpr (Steps::num_carried == 0) {
    for (int k = 0; k < count; ++k) {
      V margin = V{} + Scalar<V>(1);
      const Inputs<V> in = inputs_of<V>(batches[k]);
      write<V, num_outputs>(batches[k], margin, [&](V* out) { compute(in, out, margin); });
    }
  } else {
    V carried[most_batches_at_once][Steps::num_carried];
    V margin[most_batches_at_once];
    for (int k = 0; k < count; ++k) {
      margin[k] = V{} + Scalar<V>(1);
      Steps::template arguments<V>(inputs_of<V>(batches[k]), carried[k], carried[k], margin[k]);
    }
    for (int k = 0; k < count; ++k) {
      Steps::template functions<V>(inputs_of<V>(batches[k]), carried[k], carried[k], margin[k]);
    }
    for (int k = 0; k < count; ++k) {
      const Inputs<V> in = inputs_of<V>(batches[k]);
      write<V, num_outputs>(batches[k], margin[k], [&](V* out) {
        Steps::template rest<V>(in, carried[k], out, margin[k]);
      });
    }
  }
}

}  // namespace ELASTOGEN_INSTRUCTION_SET
}  // namespace elastogen::kernel
