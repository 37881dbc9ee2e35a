// SPDX-License-Identifier: BSD-3-Clause
// Performs the operations of CenterFinder::find_certified() in the same order, so its proof applies. Where
// that function gives up, a lane of a mask is cleared here. Only the approximate inverse differs: for n > 3
// it is elimination without row exchanges. The proof needs no more, as it bounds the defect of any inverse.
// Exact products use FMA where the processor has it, which gives the same pairs as Dekker's product.
#include "voronoi/cell_center_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/linear_bound.hpp"
#include "voronoi/roundoff.hpp"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voronoi/cell_center_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "kernel/linear-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace delone::internal {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using kernel::HWY_NAMESPACE::inverse_defect;
using kernel::HWY_NAMESPACE::invert;
using kernel::HWY_NAMESPACE::Pair;
using kernel::HWY_NAMESPACE::two_product;
using kernel::HWY_NAMESPACE::two_sum;

template <int N>
void find(const double* HWY_RESTRICT corners, const double* HWY_RESTRICT weights,
          double* HWY_RESTRICT centers, double* HWY_RESTRICT settled) {
  constexpr std::size_t n = static_cast<std::size_t>(N);
  const hn::CappedTag<double, center_block> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
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

    const V alpha = inverse_defect<N>(d, high, inverse);
    ok = hn::And(ok, hn::Lt(alpha, hn::Set(d, 0.5)));

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
