// SPDX-License-Identifier: BSD-3-Clause
#include "solve/integer_edges.hpp"

#include "kernel/grid.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace delone::solve {

using kernel::Integer;

IntegerEdges::IntegerEdges(std::span<const double* const> points, std::span<const double> weights,
                           std::size_t dimension)
    : grid(std::numeric_limits<int>::max()), dimension_(dimension) {
  for (const double* const p : points)
    for (std::size_t j = 0; j < dimension; ++j) grid = std::min(grid, kernel::trailing_exponent(p[j]));
  for (const double w : weights) grid = std::min(grid, kernel::square_exponent(w));
  if (grid == std::numeric_limits<int>::max()) grid = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    Integer square = 0;
    for (std::size_t j = 0; j < dimension; ++j) {
      edges.push_back(kernel::scaled_integer(points[i][j], grid) -
                      kernel::scaled_integer(points[0][j], grid));
      square += edges.back() * edges.back();
    }
    if (!weights.empty())
      square -= kernel::scaled_integer(weights[i], 2 * grid) - kernel::scaled_integer(weights[0], 2 * grid);
    rights.push_back(std::move(square));
  }
}

Integer IntegerEdges::dot(std::size_t a, std::size_t b) const {
  Integer sum = 0;
  for (std::size_t j = 0; j < dimension_; ++j) sum += edges[a * dimension_ + j] * edges[b * dimension_ + j];
  return sum;
}

std::vector<Integer> IntegerEdges::gram() const {
  std::vector<Integer> products;
  for (std::size_t i = 0; i < rights.size(); ++i)
    for (std::size_t m = 0; m < rights.size(); ++m) products.push_back(dot(i, m));
  return products;
}

kernel::Fractions IntegerEdges::solve_gram(std::span<const Integer> right) const {
  std::vector<Integer> system;
  for (std::size_t i = 0; i < right.size(); ++i) {
    for (std::size_t m = 0; m < right.size(); ++m) system.push_back(dot(i, m));
    system.push_back(right[i]);
  }
  return kernel::solve_exactly(std::move(system), right.size());
}

kernel::Fractions IntegerEdges::twice_center(std::size_t k) const {
  const std::size_t d = dimension_;
  if (k == d) {
    std::vector<Integer> system;
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = 0; j < d; ++j) system.push_back(edges[i * d + j]);
      system.push_back(rights[i]);
    }
    return kernel::solve_exactly(std::move(system), k);
  }
  kernel::Fractions solution = solve_gram({rights.data(), k});
  std::vector<Integer> z(d, Integer(0));
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < d; ++j) z[j] += solution.numerators[i] * edges[i * d + j];
  return {std::move(z), std::move(solution.denominator)};
}

}  // namespace delone::solve
