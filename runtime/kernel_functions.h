// Elementary functions on scalars and SIMD packs, without calls and without branches but one: that
// of logarithms near 1. Included by kernel_support.h, so by generated code only.
//
// Errors are bounded in units in the last place of the result, measured against 60 digits over the
// arguments named (tests/unit/runtime/kernel_functions_test.cpp). Not a number comes out where it
// went in and outside a function's domain.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#ifdef __SSE__
#include <immintrin.h>
#endif

#include "runtime/kernel_instruction_set.h"

namespace elastogen::kernel {
inline namespace ELASTOGEN_INSTRUCTION_SET {

/// A vector of numbers, one per element of a batch (GNU vector extension).
template <class S, int lanes>
struct pack_of {
  using type __attribute__((vector_size(lanes * sizeof(S)))) = S;
};
template <class S, int lanes>
using Pack = typename pack_of<S, lanes>::type;

/// Packs as wide as the vectors of the machine that is compiled for: compilers keep wider ones in
/// memory.
#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32;
#else
inline constexpr int vector_bytes = 16;
#endif
using DoublePack = Pack<double, vector_bytes / 8>;
using FloatPack = Pack<float, vector_bytes / 4>;

/// Scalar type of a scalar or of a pack, and the integers of its size.
template <class V>
struct pack_traits {
  using scalar = std::remove_cvref_t<decltype(std::declval<V>()[0])>;
  static constexpr int lanes = static_cast<int>(sizeof(V) / sizeof(scalar));
  using integer = Pack<std::conditional_t<sizeof(scalar) == 8, std::int64_t, std::int32_t>, lanes>;
};
template <>
struct pack_traits<double> {
  using scalar = double;
  using integer = std::int64_t;
  static constexpr int lanes = 1;
};
template <>
struct pack_traits<float> {
  using scalar = float;
  using integer = std::int32_t;
  static constexpr int lanes = 1;
};
template <class V>
using Scalar = typename pack_traits<V>::scalar;
template <class V>
using Integer = typename pack_traits<V>::integer;
template <class V>
inline constexpr int lanes_of = pack_traits<V>::lanes;

/// The number of another type that has the same bits.
template <class To, class From>
inline To bit_cast(const From& x) {
  return __builtin_bit_cast(To, x);
}

namespace functions {

template <class S>
struct Format;
/// IEEE 754 binary64, and polynomials that are minimax to 1e-16 for it.
template <>
struct Format<double> {
  static constexpr int mantissa_bits = 52;
  static constexpr std::int64_t bias = 1023;
  static constexpr std::int64_t bits_of_root_half = 0x3fe6a09e667f3bcd;  // sqrt(1/2)
  static constexpr double ln2_high = 0x1.62e42feep-1;                    // 33 bits: k times it is
  static constexpr double ln2_low = 0x1.a39ef35793c76p-33;               // exact
  static constexpr double to_integer = 0x1.8p52;
  static constexpr double infinity = __builtin_huge_val(), not_a_number = __builtin_nan("");
  static constexpr double largest_exp = 709.0, smallest_exp = -708.0;
  // (log(1 + f) / s - 2) / s^2 over s^2, f = 2 s / (1 - s): 2/3 + 2/5 s^2 + 2/7 s^4 + ...
  static constexpr double log_series[] = {
      0.6666666666666669686, 0.3999999999989950449, 0.2857142862597548492, 0.2222221113479507986,
      0.1818288912526172208, 0.1533172160055604127, 0.1461644968504340586};
  // (exp(r) - 1 - r) / r^2: 1/2 + r/6 + r^2/24 + ...
  static constexpr double exp_series[] = {0.5,
                                          0.1666666666666666666,
                                          0.04166666666666706171,
                                          0.00833333333333335966,
                                          0.001388888888870454897,
                                          0.0001984126984114699187,
                                          0.00002480158761614541272,
                                          2.755731943362024282e-6,
                                          2.755707663664272348e-7,
                                          2.505194670972162113e-8,
                                          2.096295581597607574e-9,
                                          1.611649651437154647e-10};
};
/// IEEE 754 binary32.
template <>
struct Format<float> {
  static constexpr int mantissa_bits = 23;
  static constexpr std::int32_t bias = 127;
  static constexpr std::int32_t bits_of_root_half = 0x3f3504f3;
  static constexpr float ln2_high = 0x1.62e4p-1F;
  static constexpr float ln2_low = 0x1.7f7d1cp-20F;
  static constexpr float to_integer = 0x1.8p23F;
  static constexpr float infinity = __builtin_huge_valf(), not_a_number = __builtin_nanf("");
  static constexpr float largest_exp = 88.0F, smallest_exp = -87.0F;
  static constexpr float log_series[] = {0.66666666554497F, 0.40000121839806F, 0.28550820815961F,
                                         0.23330467216304F};
  static constexpr float exp_series[] = {0.5F,
                                         0.16666667139494F,
                                         0.041666667139179F,
                                         0.0083331820715842F,
                                         0.0013888737720212F,
                                         0.00019962176226695F,
                                         0.000024922436429342F};
};

template <class V>
inline V to_floating(const Integer<V>& k) {
  if constexpr (std::is_floating_point_v<V>) {
    return static_cast<V>(k);
  } else {
    return __builtin_convertvector(k, V);
  }
}

/// 2^k as a number, for normal results.
template <class V>
inline V power_of_two(const Integer<V>& k) {
  using F = Format<Scalar<V>>;
  return bit_cast<V>(Integer<V>((k + F::bias) << F::mantissa_bits));
}

template <class V, class S, std::size_t n>
inline V polynomial(const V& x, const S (&coefficients)[n]) {
  V sum = V{} + coefficients[n - 1];
  for (std::size_t k = n - 1; k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

/// x = 2^k m with m in [sqrt(1/2), sqrt(2)), of x > 0; of any other x what 1 has, so that nothing
/// overflows: callers put not a number there.
template <class V>
struct Scaled {
  explicit Scaled(const V& x) {
    using F = Format<Scalar<V>>;
    const auto bits = bit_cast<Integer<V>>(x > Scalar<V>(0) ? x : V(V{} + Scalar<V>(1)));
    k = (bits - F::bits_of_root_half) >> F::mantissa_bits;
    m = bit_cast<V>(Integer<V>(bits - (k << F::mantissa_bits)));
  }
  Integer<V> k;
  V m;
};

/// Whether a comparison of packs holds in every lane.
template <class Mask>
inline bool all_lanes(const Mask& mask) {
#ifdef __SSE__
  if constexpr (sizeof(Mask) == 16) return _mm_movemask_ps(bit_cast<__m128>(mask)) == 0xf;
#endif
#ifdef __AVX__
  if constexpr (sizeof(Mask) == 32) return _mm256_movemask_ps(bit_cast<__m256>(mask)) == 0xff;
#endif
#ifdef __AVX512F__
  if constexpr (sizeof(Mask) == 64) {
    const __m512i bits = bit_cast<__m512i>(mask);
    return _mm512_test_epi32_mask(bits, bits) == 0xffff;
  }
#endif
  bool result = true;
  for (int l = 0; l < lanes_of<Mask>; ++l) result = result && mask[l] != 0;
  return result;
}

/// Whether a comparison holds in every lane; of numbers, whether it holds.
template <class Mask>
inline bool all(const Mask& mask) {
  if constexpr (std::is_integral_v<Mask>) {
    return mask != 0;
  } else {
    return all_lanes(mask);
  }
}

/// 1 + x = 2^k (1 + f + l) with 1 + f in [sqrt(1/2), sqrt(2)) and l what rounding f has lost:
/// log(1 + x) = k log 2 + f - (f - log(1 + f)) + l / (1 + f).
template <class V>
struct LogParts {
  V one_plus_x;
  V k;
  V f;          ///< x where k = 0
  V lost;       ///< l / (1 + f); 0 where k = 0
  V remainder;  ///< f - log(1 + f), relative to itself exact to rounding
};

/// log(1 + f) = 2 artanh(s), s = f / (2 + f); with h = f^2/2 and R = s^2 (2/3 + 2/5 s^2 + ...) it
/// is f - (h - s (h + R)): the arrangement of P. T. P. Tang, Table-driven implementation of the
/// logarithm function in IEEE floating-point arithmetic, ACM TOMS 16 (1990).
template <class V>
inline LogParts<V> log_parts(const V& x) {
  using F = Format<Scalar<V>>;
  LogParts<V> parts;
  const V u = Scalar<V>(1) + x;
  parts.one_plus_x = u;
  // Where k = 0, f is x without any arithmetic: inlined, x may be a product that compilers contract
  // into sums unrounded, once so and once so, and differences of x and f would not be 0.
  parts.k = V{};
  parts.f = x;
  parts.lost = V{};
  // Almost always so, in every lane: what waits for the logarithm need not wait for the scaling.
  if (!all((x > Scalar<V>(-0.29)) & (x < Scalar<V>(0.41)))) [[unlikely]] {
    const V back = u - Scalar<V>(1);
    const V lost = (Scalar<V>(1) - (u - back)) + (x - back);  // 1 + x - u, exactly
    const Scaled<V> scaled(u);
    parts.k = to_floating<V>(scaled.k);
    const V whole = scaled.m - Scalar<V>(1);
    const V rest = lost * power_of_two<V>(-scaled.k);
    const auto is_near = scaled.k == 0;
    parts.f = is_near ? x : V(whole + rest);
    const V low = is_near ? V{} : V((whole - parts.f) + rest);
    parts.lost = low * (Scalar<V>(1) - parts.f * (Scalar<V>(1) - parts.f));  // 1 / (1 + f), nearly
  }
  const V s = parts.f / (Scalar<V>(2) + parts.f);
  const V z = s * s;
  const V h = Scalar<V>(0.5) * parts.f * parts.f;
  parts.remainder = h - s * (h + z * polynomial(z, F::log_series));
  return parts;
}

/// `value` where `inside`, else not a number.
template <class V, class Mask>
inline V only_where(const Mask& inside, const V& value) {
  return inside ? value : V{} + Format<Scalar<V>>::not_a_number;
}

}  // namespace functions

/// max(0, -x), exactly; not a number stays what it is.
template <class V>
inline V negative_part(const V& x) {
  return x >= Scalar<V>(0) ? V{} : V(-x);
}

/// log(1 + x) for x > -1: 1.5 ulp.
template <class V>
inline V log1p(const V& x) {
  using F = functions::Format<Scalar<V>>;
  const auto parts = functions::log_parts(x);
  const V small = (parts.remainder - parts.lost) - parts.k * F::ln2_low;
  const V value = parts.k * F::ln2_high - (small - parts.f);
  return functions::only_where(parts.one_plus_x > Scalar<V>(0), value);
}

/// x - log(1 + x) for x > -1: 3 ulp; of second order near 0.
template <class V>
inline V log1p_remainder(const V& x) {
  using F = functions::Format<Scalar<V>>;
  const auto parts = functions::log_parts(x);
  const V small = (parts.remainder - parts.lost) - parts.k * F::ln2_low;
  const V value = parts.k == Scalar<V>(0) ? parts.remainder
                                          : V(((x - parts.k * F::ln2_high) - parts.f) + small);
  return functions::only_where(parts.one_plus_x > Scalar<V>(0), value);
}

/// log(x) for normal x > 0: 1.5 ulp.
template <class V>
inline V log(const V& x) {
  using F = functions::Format<Scalar<V>>;
  // 1 + (x - 1) is x but for rounding, so the parts are made from x itself.
  const functions::Scaled<V> scaled(x);
  const auto parts = functions::log_parts(V(scaled.m - Scalar<V>(1)));
  const V n = functions::to_floating<V>(scaled.k);
  const V value = n * F::ln2_high - ((parts.remainder - n * F::ln2_low) - parts.f);
  return functions::only_where((x > Scalar<V>(0)) & (x < F::infinity), value);
}

/// exp(y) - 1 - y: 2 ulp; of second order near 0. With y = n ln 2 + r it is
/// (2^n - 1 - n ln 2) + (2^n - 1) r + 2^n (exp(r) - 1 - r), where n = 0 up to |y| = 1/2.
template <class V>
inline V expm1_remainder(const V& y) {
  using F = functions::Format<Scalar<V>>;
  using S = Scalar<V>;
  constexpr S inverse_ln2 = S(1.442695040888963407);
  // Beyond these 2^n is no normal number; there the result is infinite, or -1 - y.
  V inside = y < F::smallest_exp ? V{} + F::smallest_exp : y;
  inside = inside > F::largest_exp ? V{} + F::largest_exp : inside;
  const V scaled = inside * inverse_ln2;
  const V shifted = (((y < S(0.5)) & (y > S(-0.5))) ? V{} : scaled) + F::to_integer;
  const V n = shifted - F::to_integer;
  const Integer<V> k = bit_cast<Integer<V>>(shifted) - bit_cast<Integer<V>>(V(V{} + F::to_integer));
  const V r_high = inside - n * F::ln2_high;
  const V r = r_high - n * F::ln2_low;
  const V power = functions::power_of_two<V>(k);
  const V less = power - S(1);
  const V second = r * r * functions::polynomial(r, F::exp_series);
  V value = ((less - n * F::ln2_high) + less * r) + (power * second - n * F::ln2_low);
  value = y > F::largest_exp ? V{} + F::infinity : value;
  value = y < F::smallest_exp ? V(-S(1) - y) : value;
  return functions::only_where(y == y, value);
}

/// exp(y): 1.5 ulp; 0 where it is no normal number.
template <class V>
inline V exp(const V& y) {
  using F = functions::Format<Scalar<V>>;
  using S = Scalar<V>;
  constexpr S inverse_ln2 = S(1.442695040888963407);
  const V shifted = y * inverse_ln2 + F::to_integer;
  const V n = shifted - F::to_integer;
  const Integer<V> k = bit_cast<Integer<V>>(shifted) - bit_cast<Integer<V>>(V(V{} + F::to_integer));
  const V r = (y - n * F::ln2_high) - n * F::ln2_low;
  V value = functions::power_of_two<V>(k) *
            (S(1) + (r + r * r * functions::polynomial(r, F::exp_series)));
  value = y > F::largest_exp ? V{} + F::infinity : value;
  value = y < F::smallest_exp ? V{} : value;
  return functions::only_where(y == y, value);
}

}  // namespace ELASTOGEN_INSTRUCTION_SET
}  // namespace elastogen::kernel
