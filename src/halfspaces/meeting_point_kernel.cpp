// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/meeting_point_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "base/infinity.hpp"

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "halfspaces/meeting_point_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "solve/linear_system-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace delone::halfspaces {
namespace HWY_NAMESPACE {

using namespace solve::HWY_NAMESPACE;

/// Zero, or so moderate that nothing underflows.
template <class T>
HWY_INLINE Mask<T> is_moderate(T x) {
  return either(x == 0, both(abs(x) >= 0x1p-200, abs(x) <= 0x1p200));
}

/// Sets the residual of x with its error bounds. Returns where it is certainly zero.
template <class T, int N>
HWY_INLINE Mask<T> evaluate(LinearSystem<T, N>& system) {
  constexpr double u = kernel::unit_roundoff;
  const std::size_t n = system.size();
  const auto terms = static_cast<double>(n + 1);
  const T zero = number<T>(0);
  Mask<T> is_zero = zero == 0;
  for (std::size_t i = 0; i < n; ++i) {
    T sum = system.b[i], rest = zero, magnitude = abs(system.b[i]), lost = zero;
    for (std::size_t j = 0; j < n; ++j) {
      const Pair<T> product = two_product(minus(system.a[i * n + j]), system.x[j]);
      const Pair<T> next = two_sum(sum, product.high);
      sum = next.high;
      rest = rest + (next.low + product.low);
      lost = either_bits(lost, either_bits(next.low, product.low));
      magnitude = magnitude + abs(product.high);
    }
    const T residual = sum + rest;
    system.residual[i] = residual;
    system.error[i] =
        select(lost == 0, zero, (1.01 * u) * (2 * abs(residual) + (2 * terms * terms * u) * magnitude));
    is_zero = both(is_zero, both(lost == 0, sum == 0));
  }
  return is_zero;
}

/// Solves n_i·x + c_i = 0; `entry(i, j)`: n_ij, and c_i for j = n. Each coordinate of the point is the
/// nearest double where that is certain. Rows are scaled by powers of two to entries that are zero or
/// moderate. A residual that is certainly zero settles coordinates that are zero or have few digits.
template <class T, int N, class Entry>
HWY_INLINE Mask<T> find_point(std::size_t size, Entry entry, T* point) {
  LinearSystem<T, N> system(size);
  const std::size_t n = system.size();
  const T zero = number<T>(0);
  Mask<T> certain = zero == 0;
  for (std::size_t i = 0; i < n; ++i) {
    T largest = zero;
    for (std::size_t j = 0; j < n; ++j) largest = max(largest, abs(entry(i, j)));
    const Mask<T> fits = both(largest >= 0x1p-1000, largest <= 0x1p1000);
    const T scale = powers_of_two(select(fits, largest, number<T>(1))).scale;
    certain = both(certain, fits);
    for (std::size_t j = 0; j <= n; ++j) {
      const T given = entry(i, j), scaled = given * scale;
      certain = both(certain, either(given == 0, both(is_moderate(scaled), abs(scaled) > 0)));
      (j < n ? system.a[i * n + j] : system.b[i]) = j < n ? scaled : minus(scaled);
    }
  }
  certain = both(certain, system.solve(internal::infinity, 0x1p200));
  if constexpr (is_one_lane<T>)
    if (!certain) return false;
  for (std::size_t j = 0; j < n; ++j) system.x[j] = select(is_moderate(system.x[j]), system.x[j], zero);
  const Mask<T> is_exact = evaluate(system);
  if (!all<T>(is_exact)) {
    system.correct(1e-300);
    Mask<T> moderate = zero == 0, settled = zero == 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Nearest<T> nearest = nearest_double({system.x[j], zero}, system.correction[j], system.radius[j]);
      const T improved = select(abs(nearest.value) <= nearest.radius, zero, nearest.value);
      moderate = both(moderate, is_moderate(improved));
      settled = both(settled, nearest.is_settled);
      system.x[j] = select(is_exact, system.x[j], improved);
    }
    settled = either(is_exact, both(settled, moderate));
    if (!all<T>(settled)) settled = either(settled, both(moderate, evaluate(system)));
    certain = both(certain, settled);
  }
  for (std::size_t j = 0; j < n; ++j) point[j] = system.x[j] + 0.0;  // never −0
  return certain;
}

template <int N>
void find_in_lanes(const double* HWY_RESTRICT rows, double* HWY_RESTRICT points,
                   double* HWY_RESTRICT settled) {
  constexpr std::size_t n = static_cast<std::size_t>(N);
  const hn::CappedTag<double, meeting_block> d;
  using V = hn::Vec<decltype(d)>;
  for (std::size_t lane = 0; lane < meeting_block; lane += hn::Lanes(d)) {
    const auto entry = [&](std::size_t i, std::size_t j) {
      return hn::LoadU(d, rows + (i * (n + 1) + j) * meeting_block + lane);
    };
    V point[n];
    const Mask<V> certain = find_point<V, N>(n, entry, point);
    for (std::size_t j = 0; j < n; ++j) hn::StoreU(point[j], d, points + j * meeting_block + lane);
    hn::StoreU(hn::IfThenElseZero(certain, hn::Set(d, 1.0)), d, settled + lane);
  }
}

void find_meeting_points_here(std::size_t n, const double* rows, double* points, double* settled) {
  internal::with_compiled_dimension<least_meeting_lanes, most_meeting_lanes>(n, [&](auto dimension) {
    if constexpr (dimension() > 0) find_in_lanes<dimension()>(rows, points, settled);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::halfspaces
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::halfspaces {

HWY_EXPORT(find_meeting_points_here);

void find_meeting_points_in_lanes(std::size_t n, const double* rows, double* points, double* settled) {
  HWY_DYNAMIC_DISPATCH(find_meeting_points_here)(n, rows, points, settled);
}

bool find_meeting_point(std::span<const double* const> rows, std::span<const int> columns, double* point) {
  const auto entry = [&](std::size_t i, std::size_t j) { return rows[i][columns[j]]; };
  return internal::with_compiled_dimension<1, most_meeting_lanes>(
      rows.size(), [&](auto n) { return HWY_NAMESPACE::find_point<double, n()>(rows.size(), entry, point); });
}

}  // namespace delone::halfspaces
#endif
