// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/width_test.hpp"

#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>

namespace delone::kernel {

/// The width is the length of the cross product n of two sides over that of the longest side, l. The sides
/// are off by u in relative terms, the components of n by less than 10u·l² together, so n/l by 10u·l ≤ 35u·M
/// for coordinates of at most M, and by another 7u·M because of rounded coordinates. That leaves more than a
/// factor of 1 − 20u for the rounding of the comparison.
bool is_wide_triangle(const double* p, const double* q, const double* r, double tolerance) {
  double a[3], b[3], largest = 0, aa = 0, bb = 0, cc = 0;
  for (int j = 0; j < 3; ++j) {
    a[j] = q[j] - p[j];
    b[j] = r[j] - p[j];
    const double c = r[j] - q[j];
    aa += a[j] * a[j];
    bb += b[j] * b[j];
    cc += c * c;
    largest = std::max({largest, std::abs(p[j]), std::abs(q[j]), std::abs(r[j])});
  }
  constexpr double moderate = 0x1p200;  // no product of four lengths overflows, or underflows and decides
  if (!(largest < moderate) || !(tolerance > 1 / moderate)) return false;
  const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  const double least = 2 * tolerance + 64 * unit_roundoff * largest;
  return x * x + y * y + z * z > std::max({aa, bb, cc}) * (least * least);
}

/// Let r_1 ≥ … ≥ r_m be the lengths that orthogonalisation leaves of the farthest remaining
/// vertex each time, seen from the first. These are the diagonal of a QR decomposition with column pivoting
/// of the m edges E to these, so the smallest singular value of E is at least 3·r_m/√(4^m + 6m − 1)
/// (Lawson and Hanson 1974, theorem 6.31), which is at least r_m/2^m. For a unit vector n in the flat of the
/// simplex max|n·e| ≥ |Eᵀn|/√m, so the width is at least r_m/(√m·2^m). The last line leaves a factor of 2,
/// and 1000 roundings of the largest coordinates, for rounding errors, which each elimination at most
/// doubles.
template <std::size_t D>
bool WidthTest::is_wide_in(std::span<const double* const> points, std::size_t m, std::size_t ambient,
                           double tolerance) {
  const std::size_t d = D > 0 ? D : ambient;
  const std::size_t count = points.size();
  if (count <= m) return false;
  rests_.resize(count * d);
  double largest = 0, last = 0;
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t j = 0; j < d; ++j) {
      largest = std::max(largest, std::abs(points[v][j]));
      rests_[v * d + j] = points[v][j] - points[0][j];
    }
  constexpr double moderate = 0x1p500;  // squares neither overflow nor underflow to what decides
  if (!(largest < moderate) || !(tolerance > 1 / moderate)) return false;
  for (std::size_t step = 0; step < m; ++step) {
    double most = 0;
    std::size_t farthest = 0;
    for (std::size_t v = 1; v < count; ++v) {
      double square = 0;
      for (std::size_t j = 0; j < d; ++j) square += rests_[v * d + j] * rests_[v * d + j];
      if (square > most) {
        most = square;
        farthest = v;
      }
    }
    if (!(most > 0)) return false;
    last = std::sqrt(most);
    if (step + 1 == m) break;
    direction_.assign(rests_.begin() + static_cast<std::ptrdiff_t>(farthest * d),
                      rests_.begin() + static_cast<std::ptrdiff_t>((farthest + 1) * d));
    for (double& x : direction_) x /= last;
    for (std::size_t v = 1; v < count; ++v) {
      double dot = 0;
      for (std::size_t j = 0; j < d; ++j) dot += rests_[v * d + j] * direction_[j];
      for (std::size_t j = 0; j < d; ++j) rests_[v * d + j] -= dot * direction_[j];
    }
  }
  const double power = std::ldexp(1.0, static_cast<int>(m));
  return last > power * (2 * std::sqrt(static_cast<double>(m)) * tolerance +
                         1000 * static_cast<double>(d) * unit_roundoff * largest);
}

bool WidthTest::is_wide(std::span<const double* const> points, std::size_t m, std::size_t d,
                        double tolerance) {
  switch (d) {
    case 2:
      return is_wide_in<2>(points, m, d, tolerance);
    case 3:
      return is_wide_in<3>(points, m, d, tolerance);
    case 4:
      return is_wide_in<4>(points, m, d, tolerance);
    default:
      return is_wide_in<0>(points, m, d, tolerance);
  }
}

}  // namespace delone::kernel
