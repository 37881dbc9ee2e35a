// SPDX-License-Identifier: BSD-3-Clause
// Performs the operations of CenterFinder::find_certified() in the same order, so its proof applies. Where
// that function gives up, a lane of a mask is cleared here. Only the approximate inverse differs: for n > 3
// it is elimination without row exchanges. The proof needs no more, as it bounds the defect of any inverse.
// Exact products use FMA where the processor has it, which gives the same pairs as Dekker's product.
#include "voronoi/cell_center_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voronoi/cell_center_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::internal {
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

/// a·b exactly, barring underflow and factors beyond 2^990.
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

/// An approximate inverse; infinite or NaN if the elimination fails.
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

template <int N>
void find(const double* HWY_RESTRICT corners, const double* HWY_RESTRICT weights,
          double* HWY_RESTRICT centers, double* HWY_RESTRICT settled) {
  constexpr std::size_t n = static_cast<std::size_t>(N);
  const hn::CappedTag<double, center_block> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
  constexpr double u = kernel::unit_roundoff;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const auto times = [&](double factor, V x) { return hn::Mul(hn::Set(d, factor), x); };
  for (std::size_t lane = 0; lane < center_block; lane += hn::Lanes(d)) {
    const auto corner = [&](std::size_t i, std::size_t j) {
      return hn::LoadU(d, corners + (i * n + j) * center_block + lane);
    };
    V high[n * n], low[n * n], inverse[n * n], z[n], residual[n], error[n], correction[n], tail[n];
    V largest = zero;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const Pair<V> edge = two_sum(corner(i + 1, j), hn::Neg(corner(0, j)));
        high[i * n + j] = edge.high;
        low[i * n + j] = edge.low;
        largest = hn::Max(largest, hn::Abs(edge.high));
      }
    auto ok = hn::And(hn::Gt(largest, hn::Set(d, 0x1p-100)), hn::Lt(largest, hn::Set(d, 0x1p200)));
    // By biased exponents: scale = 2^(−e−1) and unscale = 2^e for 2^e ≤ largest < 2^(e+1).
    const V safe = hn::IfThenElse(ok, largest, one);
    const auto power = hn::And(hn::BitCast(du, safe), hn::Set(du, std::uint64_t{0x7ff} << 52));
    const V unscale = hn::BitCast(d, power),
            scale = hn::BitCast(d, hn::Sub(hn::Set(du, std::uint64_t{2045} << 52), power));
    for (std::size_t i = 0; i < n * n; ++i) {
      high[i] = hn::Mul(high[i], scale);
      low[i] = hn::Mul(low[i], scale);
    }
    invert<N>(d, high, inverse);

    // As kernel::inverse_defect(). A NaN in any row fails the test of that row.
    V alpha = zero;
    for (std::size_t i = 0; i < n; ++i) {
      V row = hn::Set(d, 1e-290), magnitudes = one;
      for (std::size_t j = 0; j < n; ++j) {
        V entry = i == j ? one : zero;
        for (std::size_t m = 0; m < n; ++m) {
          const V product = hn::Mul(inverse[i * n + m], high[m * n + j]);
          entry = hn::Sub(entry, product);
          magnitudes = hn::Add(magnitudes, hn::Abs(product));
        }
        row = hn::Add(row, hn::Abs(entry));
      }
      row = hn::Add(row, times(1.01 * static_cast<double>(2 * n + 4) * u, magnitudes));
      ok = hn::And(ok, hn::Lt(row, hn::Set(d, 0.5)));
      alpha = hn::Max(alpha, row);
    }

    const auto weight_difference = [&](std::size_t i) {
      if (weights == nullptr) return Pair<V>{zero, zero};
      const Pair<V> difference = two_sum(hn::LoadU(d, weights + (i + 1) * center_block + lane),
                                         hn::Neg(hn::LoadU(d, weights + lane)));
      return Pair<V>{hn::Mul(hn::Mul(difference.high, scale), scale),
                     hn::Mul(hn::Mul(difference.low, scale), scale)};
    };
    V right[n];
    for (std::size_t i = 0; i < n; ++i) {
      right[i] = hn::Neg(weight_difference(i).high);
      for (std::size_t j = 0; j < n; ++j)
        right[i] = hn::Add(right[i], hn::Mul(high[i * n + j], high[i * n + j]));
    }
    const V too_large = hn::Set(d, 1e8);
    for (std::size_t j = 0; j < n; ++j) {
      z[j] = zero;
      for (std::size_t i = 0; i < n; ++i) {
        z[j] = hn::Add(z[j], hn::Mul(inverse[j * n + i], right[i]));
        ok = hn::And(ok, hn::Lt(hn::Abs(inverse[j * n + i]), too_large));
      }
      ok = hn::And(ok, hn::Lt(hn::Abs(z[j]), too_large));
    }
    constexpr double second_order = 1.01 * 5 * static_cast<double>((n + 3) * (n + 3)) * u * u;
    for (std::size_t i = 0; i < n; ++i) {
      const Pair<V> weight = weight_difference(i);
      V sum = hn::Neg(weight.high), rest = hn::Neg(weight.low), magnitude = hn::Abs(weight.high);
      for (std::size_t j = 0; j < n; ++j) {
        const V a = high[i * n + j], a_low = low[i * n + j];
        const Pair<V> factor = two_sum(a, hn::Neg(z[j]));
        const V factor_low = hn::Add(factor.low, a_low);
        const Pair<V> product = two_product(d, a, factor.high);
        const Pair<V> next = two_sum(sum, product.high);
        sum = next.high;
        rest = hn::Add(rest, hn::Add(hn::Add(next.low, product.low),
                                     hn::Add(hn::Mul(a, factor_low), hn::Mul(a_low, factor.high))));
        magnitude = hn::Add(magnitude, hn::Mul(hn::Abs(a), hn::Add(hn::Abs(a), hn::Abs(z[j]))));
      }
      residual[i] = hn::Add(sum, rest);
      error[i] = hn::Add(hn::Add(times(1.01 * u, hn::Abs(residual[i])), times(second_order, magnitude)),
                         hn::Set(d, 1e-280));
    }
    V zeta = zero;
    for (std::size_t j = 0; j < n; ++j) {
      correction[j] = zero;
      tail[j] = zero;
      for (std::size_t i = 0; i < n; ++i) {
        correction[j] = hn::Add(correction[j], hn::Mul(inverse[j * n + i], residual[i]));
        const V of_residual = hn::Add(error[i], times(static_cast<double>(n + 2) * u, hn::Abs(residual[i])));
        tail[j] = hn::Add(tail[j], hn::Mul(hn::Abs(inverse[j * n + i]), of_residual));
      }
      tail[j] = hn::Add(times(1.01, tail[j]), hn::Set(d, 1e-280));
      zeta = hn::Max(zeta, hn::Add(hn::Abs(correction[j]), tail[j]));
    }
    zeta = hn::Mul(zeta, hn::Div(hn::Set(d, 1.01), hn::Sub(one, alpha)));

    for (std::size_t j = 0; j < n; ++j) {
      const Pair<V> start = two_sum(corner(0, j), hn::Mul(z[j], unscale));
      const V middle = hn::Add(start.low, hn::Mul(correction[j], unscale));
      const Pair<V> rounded = two_sum(start.high, middle);
      V radius = hn::Mul(times(1.01, hn::Add(hn::Mul(alpha, zeta), tail[j])), unscale);
      radius = hn::Add(hn::Add(radius, times(2 * u, hn::Abs(middle))), times(4 * u, hn::Abs(rounded.low)));
      const V below = hn::Add(rounded.high, hn::Sub(rounded.low, radius));
      const V above = hn::Add(rounded.high, hn::Add(rounded.low, radius));
      ok = hn::And(ok, hn::Eq(below, above));
      hn::StoreU(hn::Add(above, zero), d, centers + j * center_block + lane);
    }
    hn::StoreU(hn::IfThenElseZero(ok, one), d, settled + lane);
  }
}

void find_centers_here(std::size_t n, const double* corners, const double* weights, double* centers,
                       double* settled) {
  internal::with_compiled_dimension<least_center_lanes, most_center_lanes>(n, [&](auto dimension) {
    if constexpr (dimension() > 0) find<dimension()>(corners, weights, centers, settled);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::internal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::internal {

HWY_EXPORT(find_centers_here);

void find_centers_in_lanes(std::size_t n, const double* corners, const double* weights, double* centers,
                           double* settled) {
  HWY_DYNAMIC_DISPATCH(find_centers_here)(n, corners, weights, centers, settled);
}

}  // namespace delone::internal
#endif
