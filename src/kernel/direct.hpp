// SPDX-License-Identifier: BSD-3-Clause
// Stage `direct_`: orientation and sphere determinants in floating point, translated to a point, and
// determinants of homogeneous rows, with a certified bound; and the proof of exact zeros for numbers on a
// coarse grid. Up to 6 columns the determinant is expanded in a table of minors, as it is; beyond, it is
// scaled and eliminated. What binary64 leaves open goes to arithmetic of twice its precision.
#pragma once

#include "kernel/box_corners.hpp"
#include "kernel/dependent_points.hpp"
#include "kernel/determinant.hpp"
#include "kernel/determinant_grid.hpp"
#include "kernel/double_double_stage.hpp"
#include "kernel/flat.hpp"
#include "kernel/grid.hpp"
#include "kernel/minors.hpp"
#include "kernel/multiples_stage.hpp"
#include "kernel/small_differences.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>

namespace delone::kernel {

namespace detail {

/// 2^e, or 0 or infinity where that is below or above the normal doubles. (std::ldexp is a function call, too
/// slow for a hot path.)
inline double power_of_two(std::int64_t e) {
  if (e < -1022) return 0;
  if (e > 1023) return std::numeric_limits<double>::infinity();
  return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52);
}

/// An exponent e and the scale 2^−e such that m·scale is in [1/2, 1), or smaller for the few m below 2^−1000.
/// REQUIRES m finite and positive.
struct Normalisation {
  double scale;
  int exponent;
};
inline Normalisation normalisation(double m) {
  const int e = std::max(static_cast<int>(std::bit_cast<std::uint64_t>(m) >> 52) - 1022, -1000);
  return {power_of_two(-e), e};
}

/// The least e with |x| < 2^e. REQUIRES x finite and not 0.
inline int upper_exponent(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  return biased != 0 ? biased - 1022 : -1010 - std::countl_zero(bits << 1 >> 1);
}

/// The sign of a value that is off by at most `error`, if the exact value is an integer multiple of
/// grid_unit.
inline std::optional<Sign> certified_sign(double value, double error, double grid_unit) {
  if (std::fabs(value) > error) return value > 0 ? Sign::positive : Sign::negative;
  if (std::fabs(value) + error < grid_unit) return Sign::zero;
  return std::nullopt;
}
inline std::optional<Sign> certified_sign(const CertifiedDeterminant& det, double grid_unit) {
  return certified_sign(det.value, det.error, grid_unit);
}

/// The points of a determinant of differences from a base, perhaps with a column of lifts.
struct PointsOfDeterminant {
  const Flat& flat;
  const double* const* points;
  int count;
  const double* base;
  bool has_lifts;
};
/// The sign of their determinant after it has been scaled by 2^−scale_exponent. The grid of all points is
/// known; that of these takes longer. It is no coarser than that of the base alone, which mostly is too fine.
inline std::optional<Sign> certified_sign(const CertifiedDeterminant& det, const PointsOfDeterminant& of,
                                          const Grid& grid, std::int64_t scale_exponent = 0) {
  const std::int64_t exponent = determinant_exponent(of.flat, grid, of.has_lifts);
  if (const auto sign = certified_sign(det, power_of_two(exponent - scale_exponent))) return sign;
  const auto exponent_of = [&](int count) {
    return determinant_exponent(of.flat, of.points, static_cast<std::size_t>(count), of.base, of.has_lifts);
  };
  if (!(det.error < power_of_two(exponent_of(0) - scale_exponent))) return std::nullopt;
  return certified_sign(det, power_of_two(exponent_of(of.count) - scale_exponent));
}

/// The sign of the determinant of N rows of N entries. REQUIRES that all minors and partial sums are exact in
/// binary64.
template <int N>
Sign sign_by_exact_minors(const double* a) {
  const double det = determinant_by_minors<N>(a);
  return det > 0 ? Sign::positive : det < 0 ? Sign::negative : Sign::zero;
}

/// With unscaled differences up to this and lifts up to its square no determinant overflows, and all that
/// underflows is below `unscaled_underflow` (docs/predicates.md, "By minors").
inline constexpr double moderate = 0x1p60;
inline constexpr double unscaled_underflow = 0x1p-700;

/// The sign of the determinant of N rows, of which every term goes through `roundings` roundings before the
/// minors are expanded. `last_parts[i]`: the sum of the magnitudes of the terms of the last entry of row i.
template <int N>
std::optional<Sign> sign_by_minors(const double* a, const double* last_parts, double roundings,
                                   const PointsOfDeterminant& points, const Grid& grid) {
  Magnitude parts[N * N];
  for (int i = 0; i < N; ++i) {
    for (int r = 0; r + 1 < N; ++r) parts[i * N + r].value = std::fabs(a[i * N + r]);
    parts[i * N + N - 1].value = last_parts[i];
  }
  const double value = determinant_by_minors<N>(a);
  const double permanent = determinant_by_minors<N>(parts).value;
  const double error = 1.01 * (roundings + N * (N + 1) / 2) * unit_roundoff * permanent + unscaled_underflow;
  if (std::fabs(value) > error) return value > 0 ? Sign::positive : Sign::negative;
  return certified_sign(CertifiedDeterminant{value, error}, points, grid);
}

/// direct_orientation by minors, without scaling.
template <int K>
std::optional<Sign> orientation_by_minors(const Flat& flat, const double* const* points, const double* base,
                                          const Grid& grid) {
  double a[K * K];
  for (int i = 0; i < K; ++i)
    for (int r = 0; r < K; ++r) {
      const int axis = flat.axes[static_cast<std::size_t>(r)];
      a[i * K + r] = points[i][axis] - base[axis];
    }
  if (grid.is_small()) return sign_by_exact_minors<K>(a);
  double last[K];
  double largest = 0;
  for (int i = 0; i < K; ++i) last[i] = std::fabs(a[i * K + K - 1]);
  for (const double difference : a) largest = std::max(largest, std::fabs(difference));
  if (!(largest <= moderate)) return std::nullopt;
  if (flat.ambient == K && are_small_multiples<K>(points, K, base, largest))
    return sign_by_exact_minors<K>(a);
  return sign_by_minors<K>(a, last, K, {flat, points, K, base, false}, grid);
}

/// direct_sphere by minors, without scaling.
template <int K>
std::optional<Sign> sphere_by_minors(const Flat& flat, const double* const* points, const double* q,
                                     const Grid& grid) {
  constexpr int N = K + 1;
  double a[N * N], lift_parts[N];  // |p_i − q|² + |w_i − w_q|
  double largest_difference = 0;
  for (int i = 0; i < N; ++i) {
    double lift = 0;
    for (int r = 0; r < K; ++r) {
      const int axis = flat.axes[static_cast<std::size_t>(r)];
      const double difference = points[i][axis] - q[axis];
      a[i * N + r] = difference;
      largest_difference = std::max(largest_difference, std::fabs(difference));
      lift += difference * difference;
    }
    if (flat.ambient != K) {
      lift = 0;
      for (int j = 0; j < flat.ambient; ++j) {
        const double difference = points[i][j] - q[j];
        lift += difference * difference;
      }
    }
    lift_parts[i] = lift;
    if (flat.weighted()) {
      const double weight = points[i][flat.ambient] - q[flat.ambient];
      lift -= weight;
      lift_parts[i] += std::fabs(weight);
    }
    a[i * N + K] = lift;
  }
  if (grid.is_small()) return sign_by_exact_minors<N>(a);
  double largest = 0;
  for (const double part : lift_parts) largest = std::max(largest, part);
  if (!(largest <= moderate * moderate)) return std::nullopt;
  if (flat.ambient == K && !flat.weighted() && are_small_multiples<K>(points, N, q, largest_difference))
    return sign_by_exact_minors<N>(a);
  return sign_by_minors<N>(a, lift_parts, K + flat.ambient + 3, {flat, points, N, q, true}, grid);
}

/// direct_orientation by scaled elimination.
template <int K>
std::optional<Sign> orientation_by_elimination(const Flat& flat, const double* const* points,
                                               const double* base, const Grid& grid) {
  const int k = K > 0 ? K : flat.dimension();
  Buffer<double, K * K> a(static_cast<std::size_t>(k) * static_cast<std::size_t>(k));
  Buffer<int, K> row_of(static_cast<std::size_t>(k));
  std::int64_t scale_exponent = 0;
  for (int r = 0; r < k; ++r) {
    const int axis = flat.axes[static_cast<std::size_t>(r)];
    double largest = 0;
    for (int i = 0; i < k; ++i) {
      const double difference = points[i][axis] - base[axis];
      a[static_cast<std::size_t>(i * k + r)] = difference;
      largest = std::max(largest, std::fabs(difference));
    }
    if (largest == 0) return Sign::zero;  // binary64 differences vanish only when they are exactly zero
    if (!(largest < 1e300)) return std::nullopt;
    const auto [scale, exponent] = normalisation(largest);
    for (int i = 0; i < k; ++i) a[static_cast<std::size_t>(i * k + r)] *= scale;
    scale_exponent += exponent;
  }
  const CertifiedDeterminant det = factor<K>(a.data(), k, k, {1.01 * unit_roundoff, 0}, row_of.data());
  return certified_sign(det, {flat, points, k, base, false}, grid, scale_exponent);
}

/// direct_sphere by scaled elimination.
template <int K>
std::optional<Sign> sphere_by_elimination(const Flat& flat, const double* const* points, const double* q,
                                          const Grid& grid) {
  constexpr int N = K > 0 ? K + 1 : 0;
  const int k = K > 0 ? K : flat.dimension();
  const int n = k + 1;
  Buffer<double, N * N> a(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  Buffer<int, N> row_of(static_cast<std::size_t>(n));

  double largest_of_all = 0;
  if (flat.ambient != k)
    for (int j = 0; j < flat.ambient; ++j)
      for (int i = 0; i < n; ++i) largest_of_all = std::max(largest_of_all, std::fabs(points[i][j] - q[j]));
  for (int r = 0; r < k; ++r) {
    const int axis = flat.axes[static_cast<std::size_t>(r)];
    double largest = 0;
    for (int i = 0; i < n; ++i) {
      const double difference = points[i][axis] - q[axis];
      a[static_cast<std::size_t>(i * n + r)] = difference;
      largest = std::max(largest, std::fabs(difference));
    }
    if (largest == 0) return Sign::zero;
    largest_of_all = std::max(largest_of_all, largest);
  }
  if (!(largest_of_all < 1e300)) return std::nullopt;
  auto [common_scale, common_exponent] = normalisation(largest_of_all);
  if (flat.weighted()) {
    double largest = 0;
    for (int i = 0; i < n; ++i)
      largest = std::max(largest, std::fabs(points[i][flat.ambient] - q[flat.ambient]));
    if (largest == 0 && largest_of_all == 0) return Sign::zero;  // only for k = 0
    if (!(largest < 1e300)) return std::nullopt;
    if (largest > 0) {  // squares of differences and weights have one scale: all become at most 1
      const int half = (normalisation(largest).exponent + 1) >> 1;
      common_exponent = std::max(common_exponent, half);
      common_scale = power_of_two(-common_exponent);
    }
  }
  for (int i = 0; i < n; ++i) {
    double lift = 0;
    if (flat.ambient == k) {
      for (int r = 0; r < k; ++r) {
        const double difference = a[static_cast<std::size_t>(i * n + r)] * common_scale;
        lift += difference * difference;
      }
    } else {
      for (int j = 0; j < flat.ambient; ++j) {
        const double difference = (points[i][j] - q[j]) * common_scale;
        lift += difference * difference;
      }
    }
    a[static_cast<std::size_t>(i * n + k)] = lift;
  }
  // |p_i − q|² + |w_i − w_q|, scaled
  Buffer<double, N> lift_parts(static_cast<std::size_t>(flat.weighted() ? n : 0));
  if (flat.weighted())
    for (int i = 0; i < n; ++i) {
      const double weight = (points[i][flat.ambient] - q[flat.ambient]) * common_scale * common_scale;
      double& lift = a[static_cast<std::size_t>(i * n + k)];
      lift_parts[static_cast<std::size_t>(i)] = lift + std::fabs(weight);
      lift -= weight;
    }
  std::int64_t scale_exponent = 2 * static_cast<std::int64_t>(common_exponent);
  for (int r = 0; r < k; ++r) {
    double largest = 0;
    for (int i = 0; i < n; ++i)
      largest = std::max(largest, std::fabs(a[static_cast<std::size_t>(i * n + r)]));
    const auto [scale, exponent] = normalisation(largest);
    for (int i = 0; i < n; ++i) a[static_cast<std::size_t>(i * n + r)] *= scale;
    scale_exponent += exponent;
  }
  // Differences are rounded once; a lift is a sum of `ambient` squares of rounded differences.
  double relative_error = 1.01 * (flat.ambient + 3) * unit_roundoff;
  if (flat.weighted()) {
    // A weight may cancel most of the squares: the error of a lift is relative to its parts, and these may
    // exceed the whole column by the factor `cancellation`.
    double cancellation = 1;
    for (int i = 0; i < n; ++i) {
      double largest = 0;
      for (int r = 0; r < n; ++r)
        largest = std::max(largest, std::fabs(a[static_cast<std::size_t>(i * n + r)]));
      cancellation = std::max(cancellation, lift_parts[static_cast<std::size_t>(i)] / largest);
    }
    relative_error = 1.01 * (flat.ambient + 4) * unit_roundoff * cancellation;
  }
  const CertifiedDeterminant det = factor<N>(a.data(), n, n, {relative_error, 0}, row_of.data());
  return certified_sign(det, {flat, points, n, q, true}, grid, scale_exponent);
}

}  // namespace detail

/// The sign of det(p_i − base), i < k, over the axes of the flat; nullopt when floating point cannot tell. K
/// is k, or 0 for run time.
template <int K>
std::optional<Sign> direct_orientation(const Flat& flat, const double* const* points, const double* base,
                                       const Grid& grid) {
  std::optional<Sign> sign;
  if constexpr (tabulates_minors<K>)
    sign = detail::orientation_by_minors<K>(flat, points, base, grid);
  else
    sign = detail::orientation_by_elimination<K>(flat, points, base, grid);
  if (sign) return sign;
  if (is_flat_without_one(flat, points, base)) return Sign::zero;
  if (const auto of_multiples = orientation_of_multiples(flat.axes, points, base)) return of_multiples;
  return double_double_orientation(flat, points, base);
}

/// The sign of det(p_i − q, |p_i − q|² − w_i + w_q), i = 0 … k, all weights 0 for points without; nullopt
/// when floating point cannot tell. Weighted points may have k = 0.
template <int K>
std::optional<Sign> direct_sphere(const Flat& flat, const double* const* points, const double* q,
                                  const Grid& grid) {
  std::optional<Sign> sign;
  if constexpr (tabulates_minors<K + (K > 0)>)
    sign = detail::sphere_by_minors<K>(flat, points, q, grid);
  else
    sign = detail::sphere_by_elimination<K>(flat, points, q, grid);
  if (sign) return sign;
  if (!flat.weighted() && are_corners_of_a_box(flat.ambient, points, flat.dimension() + 1, q))
    return Sign::zero;
  if (is_on_sphere_of_others(flat, points, q)) return Sign::zero;
  return double_double_sphere(flat, points, q);
}

/// The sign of the determinant of N rows of `row_size` doubles, restricted to N columns `axes`; nullopt when
/// binary64 cannot tell. N = 0: chosen at run time. Rows and columns are scaled by powers of two, so that
/// rays may have any length.
template <int N>
std::optional<Sign> direct_determinant(std::span<const int> axes, const double* const* rows) {
  const int n = N > 0 ? N : static_cast<int>(axes.size());
  const auto size = static_cast<std::size_t>(n);
  Buffer<double, N * N> a(size * size);
  Buffer<int, N> row_of(size), row_exponent(size), column_exponent(size);
  constexpr int of_zero = -100000;  // below all exponents, and far from overflow
  for (int i = 0; i < n; ++i) {
    int top = of_zero;
    for (int c = 0; c < n; ++c) {
      const double x = rows[i][axes[static_cast<std::size_t>(c)]];
      if (x != 0) top = std::max(top, detail::upper_exponent(x));
    }
    if (top == of_zero) return Sign::zero;
    row_exponent[static_cast<std::size_t>(i)] = top;
  }
  int unit_exponent = 0;
  for (int c = 0; c < n; ++c) {
    int top = of_zero, unit = -of_zero;  // of the column, in scaled rows
    for (int i = 0; i < n; ++i) {
      const double x = rows[i][axes[static_cast<std::size_t>(c)]];
      if (x == 0) continue;
      top = std::max(top, detail::upper_exponent(x) - row_exponent[static_cast<std::size_t>(i)]);
      unit = std::min(unit, trailing_exponent(x) - row_exponent[static_cast<std::size_t>(i)]);
    }
    if (top == of_zero) return Sign::zero;
    column_exponent[static_cast<std::size_t>(c)] = top;
    unit_exponent += unit - top;
  }
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < n; ++c) {
      const int shift =
          -(row_exponent[static_cast<std::size_t>(i)] + column_exponent[static_cast<std::size_t>(c)]);
      const double x = rows[i][axes[static_cast<std::size_t>(c)]];
      // At most 1 in magnitude, and exact but for underflow.
      a[static_cast<std::size_t>(i * n + c)] =
          std::abs(shift) <= 1000 ? x * detail::power_of_two(shift) : std::ldexp(x, shift);
    }
  const CertifiedDeterminant det = factor<N>(a.data(), n, n, {}, row_of.data());
  return detail::certified_sign(det, detail::power_of_two(unit_exponent));
}

/// The sign of Σ row_j·p_j + row_d, j < d; nullopt when binary64 cannot tell.
inline std::optional<Sign> direct_affine_form(const double* row, const double* p, int dimension) {
  double sum = row[dimension], parts = std::fabs(sum);
  for (int j = 0; j < dimension; ++j) {
    const double term = row[j] * p[j];
    sum += term;
    parts += std::fabs(term);
  }
  // Each term goes through at most d + 1 roundings (Higham 2002, §3.1), and each product may underflow by at
  // most 2⁻¹⁰⁷⁵.
  const double error =
      1.01 * (dimension + 2) * unit_roundoff * parts + dimension * std::numeric_limits<double>::denorm_min();
  if (std::fabs(sum) > bound_slack * error) return sum > 0 ? Sign::positive : Sign::negative;
  return std::nullopt;
}

}  // namespace delone::kernel
