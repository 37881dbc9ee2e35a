// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/ridge_width.hpp"

#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::internal {

/// Let r_1 ≥ … ≥ r_m, m = k − 1, be the lengths that orthogonalisation leaves of the farthest remaining
/// vertex each time, seen from the first. These are the diagonal of a QR decomposition with column pivoting
/// of the m edges E to these vertices, so the smallest singular value of E is at least 3·r_m/√(4^m + 6m − 1)
/// (Lawson and Hanson 1974, theorem 6.31), which is at least r_m/2^m. For a unit vector n in the flat of the
/// ridge max|n·e| ≥ |Eᵀn|/√m, so the width is at least r_m/(√m·2^m). The last line leaves a factor of 2, and
/// 1000 roundings of the largest coordinates, for rounding errors, which each elimination at most doubles.
bool RidgeWidth::is_wide(std::span<const double* const> vertices, double tolerance) {
  const std::size_t m = k_ - 1, count = vertices.size();
  if (count < k_) return false;
  rests_.resize(count * d_);
  double largest = 0, last = 0;
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t j = 0; j < d_; ++j) {
      largest = std::max(largest, std::abs(vertices[v][j]));
      rests_[v * d_ + j] = vertices[v][j] - vertices[0][j];
    }
  constexpr double moderate = 0x1p500;  // squares neither overflow nor underflow to what decides
  if (!(largest < moderate) || !(tolerance > 1 / moderate)) return false;
  for (std::size_t step = 0; step < m; ++step) {
    double most = 0;
    std::size_t farthest = 0;
    for (std::size_t v = 1; v < count; ++v) {
      double square = 0;
      for (std::size_t j = 0; j < d_; ++j) square += rests_[v * d_ + j] * rests_[v * d_ + j];
      if (square > most) {
        most = square;
        farthest = v;
      }
    }
    if (!(most > 0)) return false;
    last = std::sqrt(most);
    if (step + 1 == m) break;
    spread_.assign(rests_.begin() + static_cast<std::ptrdiff_t>(farthest * d_),
                   rests_.begin() + static_cast<std::ptrdiff_t>((farthest + 1) * d_));
    for (double& x : spread_) x /= last;
    for (std::size_t v = 1; v < count; ++v) {
      double dot = 0;
      for (std::size_t j = 0; j < d_; ++j) dot += rests_[v * d_ + j] * spread_[j];
      for (std::size_t j = 0; j < d_; ++j) rests_[v * d_ + j] -= dot * spread_[j];
    }
  }
  const double power = std::ldexp(1.0, static_cast<int>(m));
  return last > power * (2 * std::sqrt(static_cast<double>(m)) * tolerance +
                         1000 * static_cast<double>(d_) * kernel::unit_roundoff * largest);
}

double RidgeWidth::bound(std::span<const double* const> vertices) {
  constexpr double u = kernel::unit_roundoff;
  double width = std::numeric_limits<double>::infinity();
  if (k_ == 2) return kernel::distance_bound(vertices[0], vertices[1], d_, u);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double* const edge[2] = {vertices[v], vertices[(v + 1) % vertices.size()]};
    if (std::equal(edge[0], edge[0] + d_, edge[1])) continue;
    width = std::min(width, facet_bound(vertices, edge));
  }
  return width;
}

double RidgeWidth::facet_bound(std::span<const double* const> vertices,
                               std::span<const double* const> facet) {
  // The vertices of the facet farthest from each other, in a canonical order, span it best; the others are
  // within rounding errors of their flat. Which ones are taken only affects how sharp the bound is.
  independent_.assign(facet.begin(), facet.end());
  std::sort(independent_.begin(), independent_.end(), [&](const double* p, const double* q) {
    return std::lexicographical_compare(p, p + d_, q, q + d_);
  });
  std::size_t known = 1;
  while (known < independent_.size() && known + 1 < k_) {
    flat_.set_flat({independent_.data(), known}, d_, kernel::unit_roundoff);
    double most = 0;
    std::size_t farthest = known;
    for (std::size_t v = known; v < independent_.size(); ++v)
      if (const double distance = flat_.bound(independent_[v]); distance > most) {
        most = distance;
        farthest = v;
      }
    std::swap(independent_[known++], independent_[farthest]);
  }
  independent_.resize(known);
  flat_.set_flat(independent_, d_, kernel::unit_roundoff);
  double extent = 0;
  for (const double* v : vertices) {
    if (std::find(independent_.begin(), independent_.end(), v) != independent_.end()) continue;
    const double distance = flat_.bound(v);
    if (!(distance <= extent)) extent = distance;
    if (!(extent < std::numeric_limits<double>::infinity())) return extent;
  }
  return extent;
}

}  // namespace delone::internal
