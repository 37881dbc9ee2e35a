// SPDX-License-Identifier: BSD-3-Clause
// Performs the operations of find_certified() (halfspace_vertex.cpp) in the same order, so its proof applies.
// Where that function gives up, or finds that a solution with coordinates that are zero is exact, a lane of a
// mask is cleared here. Only the approximate inverse differs for n > 3. The proof bounds the defect of any
// inverse.
#include "halfspaces/meeting_point_kernel.hpp"

#include "base/compiled_dimension.hpp"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halfspaces/meeting_point_kernel.cpp"
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
void find(const double* HWY_RESTRICT rows, double* HWY_RESTRICT points, double* HWY_RESTRICT settled) {
  constexpr std::size_t n = static_cast<std::size_t>(N);
  const hn::CappedTag<double, meeting_block> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
  constexpr double u = kernel::unit_roundoff;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const auto times = [&](double factor, V x) { return hn::Mul(hn::Set(d, factor), x); };
  const auto is_within = [&](V x, double low, double high) {
    return hn::And(hn::Ge(hn::Abs(x), hn::Set(d, low)), hn::Le(hn::Abs(x), hn::Set(d, high)));
  };
  const auto is_zero_or_moderate = [&](V x) {
    return hn::Or(hn::Eq(x, zero), is_within(x, 0x1p-200, 0x1p200));
  };
  for (std::size_t lane = 0; lane < meeting_block; lane += hn::Lanes(d)) {
    const auto entry = [&](std::size_t i, std::size_t j) {
      return hn::LoadU(d, rows + (i * (n + 1) + j) * meeting_block + lane);
    };
    V a[n * n], b[n], inverse[n * n], x[n], residual[n], error[n], correction[n], tail[n];
    auto ok = hn::Eq(zero, zero);
    for (std::size_t i = 0; i < n; ++i) {
      V largest = zero;
      for (std::size_t j = 0; j < n; ++j) largest = hn::Max(largest, hn::Abs(entry(i, j)));
      const auto fits = is_within(largest, 0x1p-900, 0x1p900);
      // By biased exponents: scale = 2^(−e−1) for 2^e ≤ largest < 2^(e+1).
      const auto power = hn::And(hn::BitCast(du, hn::IfThenElse(fits, largest, one)),
                                 hn::Set(du, std::uint64_t{0x7ff} << 52));
      const V scale = hn::BitCast(d, hn::Sub(hn::Set(du, std::uint64_t{2045} << 52), power));
      ok = hn::And(ok, fits);
      for (std::size_t j = 0; j <= n; ++j) {
        const V given = entry(i, j), scaled = hn::Mul(given, scale);
        ok = hn::And(ok, hn::Or(hn::Eq(given, zero), is_within(scaled, 0x1p-200, 0x1p200)));
        (j < n ? a[i * n + j] : b[i]) = j < n ? scaled : hn::Neg(scaled);
      }
    }
    invert<N>(d, a, inverse);
    const V alpha = inverse_defect<N>(d, a, inverse);
    ok = hn::And(ok, hn::Lt(alpha, hn::Set(d, 0.5)));

    for (std::size_t j = 0; j < n; ++j) {
      V sum = zero;
      for (std::size_t i = 0; i < n; ++i) sum = hn::Add(sum, hn::Mul(inverse[j * n + i], b[i]));
      ok = hn::And(ok, hn::Le(hn::Abs(sum), hn::Set(d, 0x1p200)));
      x[j] = hn::IfThenElseZero(is_zero_or_moderate(sum), sum);
    }
    constexpr double second_order = 2 * static_cast<double>((n + 1) * (n + 1)) * u;
    for (std::size_t i = 0; i < n; ++i) {
      V sum = b[i], rest = zero, magnitude = hn::Abs(b[i]);
      for (std::size_t j = 0; j < n; ++j) {
        const Pair<V> product = two_product(d, hn::Neg(a[i * n + j]), x[j]);
        const Pair<V> next = two_sum(sum, product.high);
        sum = next.high;
        rest = hn::Add(rest, hn::Add(next.low, product.low));
        magnitude = hn::Add(magnitude, hn::Abs(product.high));
      }
      residual[i] = hn::Add(sum, rest);
      error[i] = times(1.01 * u, hn::Add(times(2, hn::Abs(residual[i])), times(second_order, magnitude)));
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
      tail[j] = hn::Add(times(1.01, tail[j]), hn::Set(d, 1e-300));
      zeta = hn::Max(zeta, hn::Add(hn::Abs(correction[j]), tail[j]));
    }
    zeta = hn::Mul(zeta, hn::Div(hn::Set(d, 1.01), hn::Sub(one, alpha)));

    for (std::size_t j = 0; j < n; ++j) {
      const Pair<V> sum = two_sum(x[j], correction[j]);
      const V radius =
          hn::Add(times(1.01, hn::Add(hn::Mul(alpha, zeta), tail[j])), times(4 * u, hn::Abs(sum.low)));
      const V below = hn::Add(sum.high, hn::Sub(sum.low, radius));
      const V above = hn::Add(sum.high, hn::Add(sum.low, radius));
      ok = hn::And(ok, hn::And(hn::Eq(below, above), is_within(sum.high, 0x1p-200, 0x1p200)));
      hn::StoreU(sum.high, d, points + j * meeting_block + lane);
    }
    hn::StoreU(hn::IfThenElseZero(ok, one), d, settled + lane);
  }
}

void find_meeting_points_here(std::size_t n, const double* rows, double* points, double* settled) {
  internal::with_compiled_dimension<least_meeting_lanes, most_meeting_lanes>(n, [&](auto dimension) {
    if constexpr (dimension() > 0) find<dimension()>(rows, points, settled);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::internal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::internal {

HWY_EXPORT(find_meeting_points_here);

void find_meeting_points_in_lanes(std::size_t n, const double* rows, double* points, double* settled) {
  HWY_DYNAMIC_DISPATCH(find_meeting_points_here)(n, rows, points, settled);
}

}  // namespace delone::internal
#endif
