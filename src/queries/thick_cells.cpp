// SPDX-License-Identifier: BSD-3-Clause
#include "queries/thick_cells.hpp"

#include "kernel/grid.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace delone::queries {
namespace {

using kernel::Integer;

/// The determinant of the Gram matrix of the edges from the first of m ≥ 1 points.
Integer gram_determinant(const std::vector<const Integer*>& points, std::size_t d) {
  const std::size_t n = points.size() - 1;
  std::vector<Integer> edges, matrix(n * n);
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t j = 0; j < d; ++j) edges.push_back(points[i][j] - points[0][j]);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a; b < n; ++b) {
      Integer& entry = matrix[a * n + b];
      for (std::size_t j = 0; j < d; ++j) entry += edges[a * d + j] * edges[b * d + j];
      matrix[b * n + a] = entry;
    }
  return n == 0 ? Integer(1) : kernel::exact_determinant(std::move(matrix), n);
}

}  // namespace

/// The squared height over a facet is the Gram determinant of the simplex divided by that of the facet.
Sign compare_least_height(std::span<const double* const> points, int dimension, double tolerance) {
  const auto d = static_cast<std::size_t>(dimension);
  int grid = kernel::trailing_exponent(tolerance);
  for (const double* p : points)
    for (std::size_t j = 0; j < d; ++j) grid = std::min(grid, kernel::trailing_exponent(p[j]));
  std::vector<Integer> coordinates;
  std::vector<const Integer*> all;
  for (const double* p : points)
    for (std::size_t j = 0; j < d; ++j) coordinates.push_back(kernel::scaled_integer(p[j], grid));
  for (std::size_t i = 0; i < points.size(); ++i) all.push_back(coordinates.data() + i * d);
  const Integer simplex = gram_determinant(all, d);
  const Integer root = kernel::scaled_integer(tolerance, grid), square = root * root;
  Sign result = Sign::positive;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<const Integer*> facet = all;
    facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
    const Integer limit = square * gram_determinant(facet, d);
    if (simplex < limit) return Sign::negative;
    if (simplex == limit) result = Sign::zero;
  }
  return result;
}

ThickCells::ThickCells(std::size_t num_slots, double tolerance)
    : tolerance_(tolerance), kinds_(std::make_unique<std::atomic<Kind>[]>(num_slots)) {}

bool ThickCells::is_thick(CellId cell, std::span<const double* const> points, int dimension,
                          kernel::NearestInHull& work) const {
  if (points.size() < 2) return true;
  std::atomic<Kind>& kind = kinds_[index(cell)];
  const Kind known = kind.load(std::memory_order_relaxed);
  if (known != Kind::unknown) return known == Kind::thick;
  const auto decide = [&] {
    if (work.least_height_down(points, dimension) > tolerance_) return true;
    std::vector<const double*> facet;
    for (std::size_t i = 0; i < points.size(); ++i) {
      facet.assign(points.begin(), points.end());
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
      if (work.flat_distance_up(facet, points[i], dimension) <= tolerance_) return false;
    }
    return compare_least_height(points, dimension, tolerance_) == Sign::positive;
  };
  const bool is_thick = decide();
  kind.store(is_thick ? Kind::thick : Kind::thin, std::memory_order_relaxed);
  return is_thick;
}

}  // namespace delone::queries
