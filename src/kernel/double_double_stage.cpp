// SPDX-License-Identifier: BSD-3-Clause
// Differences of coordinates and weights are pairs without error; lifts and minors are rounded to pairs.
// Every term of the determinant is off by a few 2^−103 relative to itself, so the determinant is off by that
// times the permanent of the magnitudes (docs/predicates.md, "Double-double"). Coordinates are scaled by
// powers of two, each axis to at most 1, and so are lifts.
#include "kernel/double_double_stage.hpp"
#include "kernel/double_double_determinant.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/determinant.hpp"
#include "kernel/determinant_grid.hpp"
#include "kernel/direct.hpp"
#include "kernel/double_double.hpp"
#include "kernel/minors.hpp"
#include "kernel/scaled_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace delone::kernel {
namespace {

/// More columns are eliminated: a table of minors would take longer.
constexpr std::size_t most_columns = 6;

/// Of sums (relative to the magnitudes of both terms) and of products.
constexpr double rounding_error = 9 * unit_roundoff * unit_roundoff;
/// Covers what underflows, with entries of at most 2^32.
constexpr double scaled_underflow = 0x1p-800;

DoubleDouble scaled(const DoubleDouble& x, double scale) { return {x.high * scale, x.low * scale}; }

/// Rows of n entries, and the sums of the magnitudes of their terms.
struct Rows {
  explicit Rows(std::size_t size) : n(size) {}  // NOLINT: entries are written before they are read
  std::size_t n;
  DoubleDouble entries[most_columns * most_columns];
  Magnitude parts[most_columns * most_columns];

  void set(std::size_t row, std::size_t column, const DoubleDouble& entry) {
    entries[row * n + column] = entry;
    parts[row * n + column].value = std::fabs(entry.high);
  }
};

/// The determinant of entries that are off by `roundings` roundings. REQUIRES 1 to 6 rows.
CertifiedDeterminant determinant_of(const Rows& rows, double roundings) {
  return internal::with_compiled_dimension<1, most_columns>(rows.n, [&](auto n) {
    constexpr int N = n();
    CertifiedDeterminant det;
    if constexpr (N > 0) {
      const double value = determinant_by_minors<N>(rows.entries).high;
      if (!std::isfinite(value)) return det;
      const double permanent = determinant_by_minors<N>(rows.parts).value;
      det.value = value;
      det.error = 1.01 * (roundings + N * (N + 1) / 2) * rounding_error * permanent + scaled_underflow +
                  unit_roundoff * std::fabs(value);  // the low part
    }
    return det;
  });
}

/// Its sign, if it is a multiple of 2^unit_exponent(), which takes time and is asked for only if it matters.
template <class UnitExponent>
std::optional<Sign> sign_of(const CertifiedDeterminant& det, UnitExponent unit_exponent) {
  if (const auto sign = detail::certified_sign(det, 0)) return sign;
  return detail::certified_sign(det, detail::power_of_two(unit_exponent()));
}

/// The largest |p_i − base| along an axis.
double extent(std::size_t n, int axis, const double* const* points, const double* base) {
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(points[i][axis] - base[axis]));
  return largest;
}

/// Fills column r with p_i − base, scaled by 2^−e to at most 1; returns e.
int fill(Rows& rows, std::size_t r, int axis, const double* const* points, const double* base,
         double largest) {
  const auto [scale, exponent] = detail::normalisation(largest);
  for (std::size_t i = 0; i < rows.n; ++i)
    rows.set(i, r, scaled(two_difference(points[i][axis], base[axis]), scale));
  return exponent;
}

std::optional<Sign> orientation_by_minors(const Flat& flat, const double* const* points, const double* base) {
  Rows rows(flat.axes.size());
  if (rows.n == 0 || rows.n > most_columns) return std::nullopt;
  double largest[most_columns];
  for (std::size_t r = 0; r < rows.n; ++r) {
    largest[r] = extent(rows.n, flat.axes[r], points, base);
    if (largest[r] == 0) return Sign::zero;  // binary64 differences vanish only when they are exactly zero
    if (!(largest[r] < largest_difference)) return std::nullopt;
  }
  std::int64_t scale_exponent = 0;
  for (std::size_t r = 0; r < rows.n; ++r)
    scale_exponent += fill(rows, r, flat.axes[r], points, base, largest[r]);
  return sign_of(determinant_of(rows, 0),
                 [&] { return determinant_exponent(flat, points, rows.n, base, false) - scale_exponent; });
}

std::optional<Sign> sphere_by_minors(const Flat& flat, const double* const* points, const double* q) {
  const std::size_t k = flat.axes.size();
  Rows rows(k + 1);
  if (rows.n > most_columns) return std::nullopt;
  std::int64_t scale_exponent = 0;
  for (std::size_t r = 0; r < k; ++r) {
    const int axis = flat.axes[r];
    const double largest = extent(rows.n, axis, points, q);
    if (largest == 0) return Sign::zero;  // binary64 differences vanish only when they are exactly zero
    if (!(largest < largest_difference)) return std::nullopt;
    scale_exponent += fill(rows, r, axis, points, q, largest);
  }
  double largest = 0;
  for (int j = 0; j < flat.ambient; ++j) largest = std::max(largest, extent(rows.n, j, points, q));
  const double largest_weight = flat.weighted() ? extent(rows.n, flat.ambient, points, q) : 0;
  if (!(largest < largest_difference && largest_weight < largest_difference)) return std::nullopt;
  // Squares of differences and weights have one scale, which makes all of them at most 1.
  int exponent = -1000;
  if (largest > 0) exponent = detail::normalisation(largest).exponent;
  if (largest_weight > 0)
    exponent = std::max(exponent, (detail::normalisation(largest_weight).exponent + 1) >> 1);
  const double scale = detail::power_of_two(-exponent);
  for (std::size_t i = 0; i < rows.n; ++i) {
    DoubleDouble lift{};
    for (int j = 0; j < flat.ambient; ++j) {
      const DoubleDouble along = scaled(two_difference(points[i][j], q[j]), scale);
      lift = lift + along * along;
    }
    rows.set(i, k, lift);
    if (!flat.weighted()) continue;
    const DoubleDouble weight =
        scaled(scaled(two_difference(points[i][flat.ambient], q[flat.ambient]), scale), scale);
    rows.entries[i * rows.n + k] = lift - weight;
    rows.parts[i * rows.n + k].value += std::fabs(weight.high);
  }
  scale_exponent += 2 * exponent;
  return sign_of(determinant_of(rows, flat.ambient + 1),
                 [&] { return determinant_exponent(flat, points, rows.n, q, true) - scale_exponent; });
}

}  // namespace

/// Each row is scaled to at most 1. A term of the determinant has an entry of each row, so it is a multiple
/// of the product of their units.
std::optional<Sign> double_double_determinant(std::span<const int> axes, const double* const* rows) {
  if (axes.empty() || axes.size() > most_columns) return std::nullopt;
  Rows scaled_rows(axes.size());
  std::int64_t unit_exponent = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    double largest = 0;
    int unit = std::numeric_limits<int>::max();
    for (const int axis : axes) {
      largest = std::max(largest, std::fabs(rows[i][axis]));
      unit = std::min(unit, trailing_exponent(rows[i][axis]));
    }
    if (largest == 0) return Sign::zero;
    if (!(largest < largest_difference)) return std::nullopt;
    const auto [scale, exponent] = detail::normalisation(largest);
    for (std::size_t c = 0; c < axes.size(); ++c) scaled_rows.set(i, c, {rows[i][axes[c]] * scale, 0.0});
    unit_exponent += unit - exponent;
  }
  return sign_of(determinant_of(scaled_rows, 0), [&] { return unit_exponent; });
}

std::optional<Sign> double_double_orientation(const Flat& flat, const double* const* points,
                                              const double* base) {
  const auto sign = orientation_by_minors(flat, points, base);
  return sign ? sign : scaled_orientation(flat, points, base);
}

std::optional<Sign> double_double_sphere(const Flat& flat, const double* const* points, const double* q) {
  const auto sign = sphere_by_minors(flat, points, q);
  return sign ? sign : scaled_sphere(flat, points, q);
}

}  // namespace delone::kernel
