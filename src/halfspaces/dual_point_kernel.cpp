// SPDX-License-Identifier: BSD-3-Clause
// The sum s = −(n·p + c) in pairs of doubles. Each product is exactly a pair, and so is each addition to the
// leading sum. With M = Σ|n_j·p_j| + |c|, the 2d + 1 low parts are at most (d + 2)·u·M together, and summing
// them adds an error of at most (2d + 2)·u times that. So s is off by less than 2(d + 3)²·u²·M. If this is at
// most 2⁻⁷⁰·|s|, the quotients are off by at most 2⁻⁶⁹: quotient and remainder of the division by the leading
// part are exact, and the rounding of the correction is of third order.
#include "halfspaces/dual_point_kernel.hpp"

#include <algorithm>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "halfspaces/dual_point_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "solve/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace delone::halfspaces {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace solve::HWY_NAMESPACE;

/// Where an entry was given as zero, or is so moderate after scaling that neither products nor their rounding
/// errors leave the range of doubles.
template <class T>
HWY_INLINE Mask<T> is_harmless(T given, T scaled, double limit) {
  return either(given == 0, both(abs(scaled) >= 1 / limit, abs(scaled) <= limit));
}

/// Rows are scaled by powers of two, which changes no quotient. REQUIRES a point whose coordinates are zero
/// or moderate.
template <class T, class Entry, class Write>
HWY_INLINE Mask<T> find_dual_of(Entry entry, std::span<const double> p, std::span<const int> axes,
                                Write write) {
  const std::size_t d = p.size();
  T largest = number<T>(0);
  for (std::size_t j = 0; j < d; ++j) largest = max(largest, abs(entry(j)));
  Mask<T> certain = both(largest >= 0x1p-1000, largest <= 0x1p1000);
  const T scale = powers_of_two(select(certain, largest, number<T>(1))).scale;
  T sum = entry(d) * scale, rest = number<T>(0), magnitude = abs(sum);
  certain = both(certain, is_harmless(entry(d), sum, 0x1p400));
  for (std::size_t j = 0; j < d; ++j) {
    const T n = entry(j) * scale;
    certain = both(certain, is_harmless(entry(j), n, 0x1p200));
    const Pair<T> product = two_product(n, number<T>(p[j])), next = two_sum(sum, product.high);
    sum = next.high;
    rest = rest + (next.low + product.low);
    magnitude = magnitude + abs(product.high);
  }
  const double terms = static_cast<double>(d) + 3;
  const Pair<T> s = two_sum(minus(sum), minus(rest));
  certain = both(certain, both(s.high > 0, 2.1 * terms * terms * 0x1p-106 * magnitude <= 0x1p-71 * s.high));
  const std::size_t k = axes.size();
  for (std::size_t j = 0; j < k; ++j) {
    const T n = entry(static_cast<std::size_t>(axes[j])) * scale;
    const T quotient = n / s.high;
    const Pair<T> back = two_product(quotient, s.high);
    write(j, quotient);
    write(k + j, (((n - back.high) - back.low) - quotient * s.low) / s.high);
  }
  return certain;
}

void find_duals_here(const double* HWY_RESTRICT rows, std::span<const double> p, std::span<const int> axes,
                     double* HWY_RESTRICT duals, double* HWY_RESTRICT settled) {
  const hn::CappedTag<double, dual_block> d;
  using V = hn::Vec<decltype(d)>;
  for (std::size_t lane = 0; lane < dual_block; lane += hn::Lanes(d)) {
    const auto entry = [&](std::size_t j) { return hn::LoadU(d, rows + j * dual_block + lane); };
    const auto write = [&](std::size_t j, V x) { hn::StoreU(x, d, duals + j * dual_block + lane); };
    const Mask<V> certain = find_dual_of<V>(entry, p, axes, write);
    hn::StoreU(hn::IfThenElseZero(certain, hn::Set(d, 1.0)), d, settled + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::halfspaces
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::halfspaces {

HWY_EXPORT(find_duals_here);

namespace {
bool is_moderate(std::span<const double> p) {
  return std::all_of(p.begin(), p.end(),
                     [](double x) { return HWY_NAMESPACE::is_harmless<double>(x, x, 0x1p200); });
}
}  // namespace

void find_duals_in_lanes(const double* rows, std::span<const double> p, std::span<const int> axes,
                         double* duals, double* settled) {
  if (is_moderate(p))
    HWY_DYNAMIC_DISPATCH(find_duals_here)(rows, p, axes, duals, settled);
  else
    std::fill_n(settled, dual_block, 0.0);
}

bool find_dual(const double* row, std::span<const double> p, std::span<const int> axes, double* dual) {
  return is_moderate(p) && HWY_NAMESPACE::find_dual_of<double>([&](std::size_t j) { return row[j]; }, p, axes,
                                                               [&](std::size_t j, double x) { dual[j] = x; });
}

}  // namespace delone::halfspaces
#endif
