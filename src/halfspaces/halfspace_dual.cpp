// SPDX-License-Identifier: BSD-3-Clause
// The sum s = −(n·p + c) in pairs of doubles. Each product is exactly a pair, and so is each addition to the
// leading sum. With M = Σ|n_j·p_j| + |c|, the 2d + 1 low parts are at most (d + 2)·u·M together, and summing
// them adds an error of at most (2d + 2)·u times that. So s is off by less than 2(d + 3)²·u²·M. If this is at
// most 2⁻⁷⁰·|s|, the quotients are off by at most 2⁻⁶⁹: quotient and remainder of the division by the leading
// part are exact, and the rounding of the correction is of third order.
#include "halfspaces/halfspace_dual.hpp"

#include "kernel/double_double.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::halfspaces {
namespace {

/// Zero, or so moderate that neither products nor their rounding errors leave the range of doubles.
bool is_moderate(double x, double limit) {
  return x == 0 || (std::abs(x) >= 1 / limit && std::abs(x) <= limit);
}

bool find_in_pairs(const double* row, const std::vector<double>& p, std::span<const int> axes, double* dual) {
  const std::size_t d = p.size();
  double largest = 0;
  for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::abs(row[j]));
  if (!(largest >= 0x1p-1000 && largest <= 0x1p1000)) return false;
  // 2^−e for 2^e ≤ largest < 2^(e+1), by its biased exponent.
  const double scale = std::bit_cast<double>((2046 - (std::bit_cast<std::uint64_t>(largest) >> 52)) << 52);
  const double offset = row[d] * scale;
  if (!is_moderate(offset, 0x1p400)) return false;
  double sum = offset, rest = 0, magnitude = std::abs(offset);
  for (std::size_t j = 0; j < d; ++j) {
    const double n = row[j] * scale;
    if (!is_moderate(n, 0x1p200) || !is_moderate(p[j], 0x1p200) || (n == 0) != (row[j] == 0)) return false;
    const kernel::DoubleDouble product = kernel::two_product(n, p[j]);
    const kernel::DoubleDouble next = kernel::two_sum(sum, product.high);
    sum = next.high;
    rest += next.low + product.low;
    magnitude += std::abs(product.high);
  }
  const double terms = static_cast<double>(d) + 3;
  const kernel::DoubleDouble s = kernel::two_sum(-sum, -rest);
  if ((offset == 0) != (row[d] == 0) || !(s.high > 0) ||
      !(2.1 * terms * terms * 0x1p-106 * magnitude <= 0x1p-71 * s.high))
    return false;
  const std::size_t k = axes.size();
  for (std::size_t j = 0; j < k; ++j) {
    const double n = row[axes[j]] * scale;
    dual[j] = n / s.high;
    const kernel::DoubleDouble back = kernel::two_product(dual[j], s.high);
    dual[k + j] = (((n - back.high) - back.low) - dual[j] * s.low) / s.high;
  }
  return true;
}

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
  if (!p.is_exact() || !find_in_pairs(row, p.rounded, axes, dual)) find_in_integers(row, p, axes, dual);
}

}  // namespace delone::halfspaces
