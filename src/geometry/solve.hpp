// SPDX-License-Identifier: BSD-3-Clause
// Functionals by elimination, O(k³): of first cells, after a dimension jump, and where the pencil's
// certificate is too weak.
#pragma once

#include "geometry/cache_line.hpp"
#include "geometry/functionals.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>

namespace delone::geometry {

template <int K, bool Lifted>
template <bool Infinite>
Sign Functionals<K, Lifted>::solve(Index cell, const double* rows, bool positive) requires(Lifted) {
  if constexpr (K == 2 && !Infinite) return solve_triangle(cell, rows);
  const int n = Infinite ? k() - 1 : k();                // the vertices besides the apex
  constexpr int N = K > 0 ? (Infinite ? K - 1 : K) : 0;  // n, or 0 if n is not known or is 0
  const auto size = static_cast<std::size_t>(k());
  const auto row_at = [&](int i) { return rows + static_cast<std::ptrdiff_t>(i) * (k() + 1); };
  double* functional = this->functional(cell);

  kernel::Buffer<double, K * K> columns(size * size);
  kernel::Buffer<int, K> row_of(size);
  kernel::Buffer<double, K> heights(size);
  for (int j = 0; j < n; ++j) {
    for (int r = 0; r < k(); ++r) columns[static_cast<std::size_t>(j * k() + r)] = row_at(j + 1)[r] - rows[r];
    heights[static_cast<std::size_t>(j)] = Infinite ? 0 : row_at(j + 1)[k()] - rows[k()];
  }
  // Each of the two images of a difference is off by a rounding of a number ≤ 1, and the difference is
  // rounded once more.
  const kernel::EntryError entry_error{1.01 * kernel::unit_roundoff,
                                       2.02 * kernel::unit_roundoff * std::sqrt(static_cast<double>(k()))};
  const kernel::CertifiedDeterminant det =
      kernel::factor<N>(columns.data(), n, k(), entry_error, row_of.data());
  const double least_determinant = std::fabs(det.value) - det.error;
  if (!(least_determinant > 0)) {
    give_up(cell, Infinite);
    return Sign::zero;
  }
  if constexpr (Infinite) functional[k() - 1] = positive == (det.value > 0) ? 1.0 : -1.0;
  kernel::solve_transposed<N>(columns.data(), n, k(), row_of.data(), heights.data(), functional);

  constexpr double lift_weight = Infinite ? 0 : 1;
  const auto linear_part = [&](const double* x) {
    double sum = lift_weight * x[k()];
    for (int r = 0; r < k(); ++r) sum += functional[r] * x[r];
    return sum;
  };
  functional[k()] = -linear_part(rows);

  double residual = 0;
  for (int i = 0; i <= n; ++i)
    residual = std::max(residual, std::fabs(linear_part(row_at(i)) + functional[k()]));
  double magnitude = lift_weight * largest_lift_;
  for (int r = 0; r <= k(); ++r) magnitude += std::fabs(functional[r]);
  const double rounding = evaluation_error_ * magnitude;
  const double error = residual + rounding;
  // Σ|barycentric coordinates| in the box, by Cramer's rule and Hadamard's inequality.
  const double spread = 1 + 4.5 * std::sqrt(static_cast<double>(n)) * det.norm_product *
                                det.inverse_norm_sum / least_determinant;
  certify(cell, error * spread + rounding, error, least_determinant, Infinite);
  return det.value > 0 ? Sign::positive : Sign::negative;
}

/// By Cramer's rule. An image is off by a rounding of a number ≤ 1, so with u = 2⁻⁵³ an edge of length e ≤ 2
/// is off by 1.01u·e + 2.02u ≤ 4.1u per axis. Of the two products of the determinant, this changes each
/// by 2.02u of itself, 2.02u times the sum of its factors and 17u²; roundings add another 2.1u of both.
/// Σ|barycentric coordinates| in the box, whose diagonal is √8, is at most 1 + 2·√8·(sum of the lengths)/det,
/// and the lengths are at most 5.8u more than computed. How far the functional is off at the vertices is
/// measured.
template <int K, bool Lifted>
Sign Functionals<K, Lifted>::solve_triangle(Index cell, const double* rows) requires(Lifted&& K == 2) {
  const double x1 = rows[3] - rows[0], y1 = rows[4] - rows[1], z1 = rows[5] - rows[2];
  const double x2 = rows[6] - rows[0], y2 = rows[7] - rows[1], z2 = rows[8] - rows[2];
  const double left = x1 * y2, right = x2 * y1, determinant = left - right;
  const double sum = std::fabs(x1) + std::fabs(y1) + std::fabs(x2) + std::fabs(y2);
  constexpr double u = kernel::unit_roundoff;
  const double least_determinant =
      std::fabs(determinant) - u * (5 * (std::fabs(left) + std::fabs(right)) + 3 * sum + 64 * u);
  if (!(least_determinant > 0)) {
    give_up(cell, false);
    return Sign::zero;
  }
  double* const functional = this->functional(cell);
  const double per_determinant = 1 / determinant;
  const double g0 = (z2 * y1 - z1 * y2) * per_determinant, g1 = (z1 * x2 - z2 * x1) * per_determinant;
  const auto linear_part = [&](const double* x) { return x[2] + g0 * x[0] + g1 * x[1]; };
  const double constant = -linear_part(rows);
  functional[0] = g0;
  functional[1] = g1;
  functional[2] = constant;
  double residual = 0;
  for (int i = 0; i < 9; i += 3) residual = std::max(residual, std::fabs(linear_part(rows + i) + constant));
  const double rounding = evaluation_error_ * sum_of_magnitudes(cell, largest_lift_);
  const double error = residual + rounding;
  certify(cell, error * (1 + 6 * (sum + 6 * u) / least_determinant) + rounding, error, least_determinant,
          false);
  return determinant > 0 ? Sign::positive : Sign::negative;
}

template <int K, bool Lifted>
void Functionals<K, Lifted>::solve(std::span<const Index> cells, std::span<const Index* const> vertices,
                                   const double* rows, Sign* signs) requires(Lifted) {
  scratch_.resize(simplex_scratch(k()) + cache_line_of<double>);
  double* const functions = at_cache_line(scratch_.data());
  const SimplexTask task{k(), vertices, rows, functions};
  SimplexCertificate certificates[simplex_lanes];
  solve_simplices(task);
  certify_simplices(task, certificates);
  const auto width = static_cast<std::size_t>(k()) + 1;
  for (std::size_t lane = 0; lane < cells.size(); ++lane) {
    const SimplexCertificate& proved = certificates[lane];
    signs[lane] = proved.orientation;
    if (proved.orientation == Sign::zero) continue;
    for (std::size_t r = 0; r < width; ++r)
      functional(cells[lane])[r] = lane_entry(functions, width * width + r, lane);
    const double rounding = evaluation_error_ * sum_of_magnitudes(cells[lane], largest_lift_);
    const double error = proved.residual + rounding;
    certify(cells[lane], error * proved.spread + rounding, error, proved.determinant, false);
  }
}

template <int K, bool Lifted>
void Functionals<K, Lifted>::solve(Index cell, const double* rows) requires(!Lifted) {
  const int n = k() + 1;
  constexpr int N = K > 0 ? K + 1 : 0;
  const auto size = static_cast<std::size_t>(n);
  kernel::Buffer<double, N * N> columns(size * size);
  kernel::Buffer<int, N> row_of(size);
  kernel::Buffer<double, N> ones(size);
  std::copy_n(rows, size * size, columns.data());
  std::fill_n(ones.data(), size, 1.0);
  const kernel::EntryError entry_error{0, 1.01 * kernel::unit_roundoff * std::sqrt(static_cast<double>(n))};
  const kernel::CertifiedDeterminant det =
      kernel::factor<N>(columns.data(), n, n, entry_error, row_of.data());
  const double least_determinant = std::fabs(det.value) - det.error;
  if (!(least_determinant > 0)) {
    give_up(cell, false);
    return;
  }
  double* functional = this->functional(cell);
  kernel::solve_transposed<N>(columns.data(), n, n, row_of.data(), ones.data(), functional);

  double residual = 0, magnitude = 1;
  for (int i = 0; i < n; ++i) {
    double sum = 1;
    for (int r = 0; r < n; ++r) sum += functional[r] * rows[i * n + r];
    residual = std::max(residual, std::fabs(sum));
    magnitude += std::fabs(functional[i]);
  }
  const double rounding = evaluation_error_ * magnitude;
  const double error = residual + rounding;
  // As above, with the coefficients of rows in place of barycentric coordinates; the row of a point, at most
  // √n long, replaces one of them.
  const double spread =
      1.2 * std::sqrt(static_cast<double>(n)) * det.norm_product * det.inverse_norm_sum / least_determinant;
  certify(cell, error * spread + rounding, error, least_determinant, false);
}

/// For cells too flat to be certified: the filter is never certain, and a walk never prefers the cell.
template <int K, bool Lifted>
void Functionals<K, Lifted>::give_up(Index cell, bool infinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::fill_n(functional(cell), k() + 1, 0.0);
  if (Lifted) functional(cell)[k()] = infinity;
  certify(cell, infinity, infinity, 0, infinite);
}

}  // namespace delone::geometry
