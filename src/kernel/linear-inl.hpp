// SPDX-License-Identifier: BSD-3-Clause
// Pairs of doubles and approximate inverses (kernel/double_double.hpp, kernel/linear_bound.hpp) with one
// number or matrix per SIMD lane. Included once for each instruction set, after hwy/highway.h.
#if defined(DELONE_KERNEL_LINEAR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DELONE_KERNEL_LINEAR_INL
#undef DELONE_KERNEL_LINEAR_INL
#else
#define DELONE_KERNEL_LINEAR_INL
#endif

#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace delone::kernel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Pair {
  V high, low;
};

/// a + b exactly, barring overflow.
template <class V>
inline Pair<V> two_sum(V a, V b) {
  const V sum = hn::Add(a, b), part = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, part)), hn::Sub(b, part))};
}

/// a·b exactly, barring underflow and factors beyond 2^990. FMA, where the processor has it, gives the same
/// pair as Dekker's product.
template <class D, class V = hn::Vec<D>>
inline Pair<V> two_product([[maybe_unused]] D d, V a, V b) {
  const V product = hn::Mul(a, b);
#if HWY_NATIVE_FMA
  return {product, hn::MulSub(a, b, product)};
#else
  const V splitter = hn::Set(d, 0x1p27 + 1);
  const auto split = [&](V x) {
    const V scaled = hn::Mul(splitter, x), high = hn::Sub(scaled, hn::Sub(scaled, x));
    return Pair<V>{high, hn::Sub(x, high)};
  };
  const Pair<V> x = split(a), y = split(b);
  V low = hn::Sub(hn::Mul(x.high, y.high), product);
  low = hn::Add(low, hn::Mul(x.high, y.low));
  low = hn::Add(low, hn::Mul(x.low, y.high));
  return {product, hn::Add(low, hn::Mul(x.low, y.low))};
#endif
}

/// An approximate inverse of a: by cofactors for N = 2, 3, otherwise by elimination without row exchanges.
/// Infinite or NaN if that fails.
template <int N, class D, class V = hn::Vec<D>>
inline void invert(D d, const V* a, V* inverse) {
  const auto minor = [](V p, V q, V r, V s) { return hn::Sub(hn::Mul(p, q), hn::Mul(r, s)); };
  const V one = hn::Set(d, 1.0);
  if constexpr (N == 2) {
    const V scale = hn::Div(one, minor(a[0], a[3], a[1], a[2]));
    inverse[0] = hn::Mul(a[3], scale);
    inverse[1] = hn::Mul(hn::Neg(a[1]), scale);
    inverse[2] = hn::Mul(hn::Neg(a[2]), scale);
    inverse[3] = hn::Mul(a[0], scale);
  } else if constexpr (N > 3) {
    // Gauss–Jordan in place: after step s, columns 0 … s are those of the inverse.
    std::copy_n(a, N * N, inverse);
    for (int s = 0; s < N; ++s) {
      const V scale = hn::Div(one, inverse[s * N + s]);
      inverse[s * N + s] = one;
      for (int c = 0; c < N; ++c) inverse[s * N + c] = hn::Mul(inverse[s * N + c], scale);
      for (int r = 0; r < N; ++r) {
        if (r == s) continue;
        const V factor = inverse[r * N + s];
        inverse[r * N + s] = hn::Zero(d);
        for (int c = 0; c < N; ++c)
          inverse[r * N + c] = hn::Sub(inverse[r * N + c], hn::Mul(factor, inverse[s * N + c]));
      }
    }
  } else {
    const V c0 = minor(a[4], a[8], a[5], a[7]), c1 = minor(a[5], a[6], a[3], a[8]),
            c2 = minor(a[3], a[7], a[4], a[6]);
    const V scale = hn::Div(one, hn::Add(hn::Add(hn::Mul(a[0], c0), hn::Mul(a[1], c1)), hn::Mul(a[2], c2)));
    inverse[0] = hn::Mul(c0, scale);
    inverse[1] = hn::Mul(minor(a[2], a[7], a[1], a[8]), scale);
    inverse[2] = hn::Mul(minor(a[1], a[5], a[2], a[4]), scale);
    inverse[3] = hn::Mul(c1, scale);
    inverse[4] = hn::Mul(minor(a[0], a[8], a[2], a[6]), scale);
    inverse[5] = hn::Mul(minor(a[2], a[3], a[0], a[5]), scale);
    inverse[6] = hn::Mul(c2, scale);
    inverse[7] = hn::Mul(minor(a[1], a[6], a[0], a[7]), scale);
    inverse[8] = hn::Mul(minor(a[0], a[4], a[1], a[3]), scale);
  }
}

/// As kernel::inverse_defect(); infinite if that or any number of it is too large or none.
template <int N, class D, class V = hn::Vec<D>>
inline V inverse_defect(D d, const V* a, const V* inverse) {
  constexpr std::size_t n = static_cast<std::size_t>(N);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  V largest = zero;
  for (std::size_t i = 0; i < n; ++i) {
    V row = hn::Set(d, 1e-290), magnitudes = one;
    for (std::size_t j = 0; j < n; ++j) {
      V entry = i == j ? one : zero;
      for (std::size_t m = 0; m < n; ++m) {
        const V product = hn::Mul(inverse[i * n + m], a[m * n + j]);
        entry = hn::Sub(entry, product);
        magnitudes = hn::Add(magnitudes, hn::Abs(product));
      }
      row = hn::Add(row, hn::Abs(entry));
    }
    row =
        hn::Add(row, hn::Mul(hn::Set(d, 1.01 * static_cast<double>(2 * n + 4) * unit_roundoff), magnitudes));
    largest = hn::IfThenElse(hn::Lt(row, one), hn::Max(largest, row), hn::Inf(d));
  }
  return largest;
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::kernel
HWY_AFTER_NAMESPACE();

#endif
