// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/halfspace_dual.hpp"

#include "halfspaces/dual_point_kernel.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::halfspaces {
namespace {

void find_in_integers(const double* row, const InteriorPoint& p, std::span<const int> axes, double* dual) {
  const std::size_t d = p.rounded.size();
  const std::vector<kernel::Integer> n = integer_row(row, d + 1);
  int exponent = p.exponent;
  std::vector<kernel::Integer> numerators = p.numerators;
  if (p.is_exact()) {
    exponent = common_exponent(p.rounded);
    for (const double x : p.rounded) numerators.push_back(kernel::scaled_integer(x, exponent));
  }
  // −(n·p + c) times denominator·2^−below
  const int below = std::min(exponent, 0);
  kernel::Integer sum = 0;
  for (std::size_t j = 0; j < d; ++j) sum -= n[j] * numerators[j];
  sum <<= exponent - below;
  sum -= (n[d] * p.denominator) << -below;

  const std::size_t k = axes.size();
  for (std::size_t j = 0; j < k; ++j) {
    const kernel::Integer numerator = (n[static_cast<std::size_t>(axes[j])] * p.denominator) << -below;
    dual[j] = kernel::nearest_double(numerator, sum, 0);
    dual[k + j] = 0;
    if (dual[j] == 0 || !std::isfinite(dual[j])) continue;
    const int grid = kernel::trailing_exponent(dual[j]), common = std::min(grid, 0);
    const kernel::Integer left =
        (numerator << -common) - ((kernel::scaled_integer(dual[j], grid) * sum) << (grid - common));
    dual[k + j] = kernel::nearest_double(left, sum, common);
  }
}

}  // namespace

int common_exponent(std::span<const double> numbers) {
  constexpr int none = std::numeric_limits<int>::max();
  int exponent = none;
  for (const double x : numbers) exponent = std::min(exponent, kernel::trailing_exponent(x));
  return exponent == none ? 0 : exponent;
}

std::vector<kernel::Integer> integer_row(const double* row, std::size_t size) {
  const int exponent = common_exponent({row, size});
  std::vector<kernel::Integer> integers;
  for (std::size_t j = 0; j < size; ++j) integers.push_back(kernel::scaled_integer(row[j], exponent));
  return integers;
}

void dual_point(const double* row, const InteriorPoint& p, std::span<const int> axes, double* dual) {
  if (!p.is_exact() || !find_dual(row, p.rounded, axes, dual)) find_in_integers(row, p, axes, dual);
}

void dual_points(const double* rows, std::size_t count, const InteriorPoint& p, std::span<const int> axes,
                 double* duals) {
  const std::size_t row_size = p.rounded.size() + 1, width = 2 * axes.size();
  std::size_t next = 0;
  if (p.is_exact() && count >= dual_block) {
    std::vector<double> entries(row_size * dual_block), found(width * dual_block), settled(dual_block);
    for (; next + dual_block <= count; next += dual_block) {
      const double* const block = rows + next * row_size;
      for (std::size_t j = 0; j < row_size; ++j)
        for (std::size_t lane = 0; lane < dual_block; ++lane)
          entries[j * dual_block + lane] = block[lane * row_size + j];
      find_duals_in_lanes(entries.data(), p.rounded, axes, found.data(), settled.data());
      for (std::size_t lane = 0; lane < dual_block; ++lane) {
        double* const dual = duals + (next + lane) * width;
        if (settled[lane] == 0)
          find_in_integers(block + lane * row_size, p, axes, dual);
        else
          for (std::size_t j = 0; j < width; ++j) dual[j] = found[j * dual_block + lane];
      }
    }
  }
  for (; next < count; ++next) dual_point(rows + next * row_size, p, axes, duals + next * width);
}

}  // namespace delone::halfspaces
