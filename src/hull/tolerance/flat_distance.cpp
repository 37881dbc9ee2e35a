// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/flat_distance.hpp"

#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delone::internal {
namespace {

using kernel::Integer;

Integer gram_determinant(const std::vector<Integer>& vectors, std::size_t count, std::size_t d) {
  std::vector<Integer> products(count * count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      Integer sum(0);
      for (std::size_t j = 0; j < d; ++j) sum += vectors[a * d + j] * vectors[b * d + j];
      products[b * count + a] = sum;
      products[a * count + b] = std::move(sum);
    }
  return kernel::exact_determinant(std::move(products), count);
}

}  // namespace

bool is_near_flat(std::span<const double* const> points, const double* q, int dimension, double tolerance) {
  const auto d = static_cast<std::size_t>(dimension);
  int grid = kernel::trailing_exponent(tolerance);
  for (std::size_t j = 0; j < d; ++j) {
    grid = std::min(grid, kernel::trailing_exponent(q[j]));
    for (const double* p : points) grid = std::min(grid, kernel::trailing_exponent(p[j]));
  }
  std::vector<Integer> vectors;
  for (std::size_t i = 1; i <= points.size(); ++i)
    for (std::size_t j = 0; j < d; ++j)
      vectors.push_back(kernel::scaled_integer(i < points.size() ? points[i][j] : q[j], grid) -
                        kernel::scaled_integer(points[0][j], grid));
  const Integer base = gram_determinant(vectors, points.size() - 1, d);
  if (base == 0) return false;
  const Integer root = kernel::scaled_integer(tolerance, grid);
  return gram_determinant(vectors, points.size(), d) <= root * root * base;
}

NearFlat::NearFlat(int dimension, int k, double tolerance)
    : dimension_(dimension), tolerance_(tolerance), normal_(k), axes_(static_cast<std::size_t>(dimension)) {
  std::iota(axes_.begin(), axes_.end(), 0);
}

void NearFlat::set(std::span<const double* const> points) {
  points_.assign(points.begin(), points.end());
  is_known_ = points.size() == axes_.size() && normal_.compute(points_.data(), axes_, false);
}

/// With |N − N′| ≤ e for the exact normal N′, |N·t − N′·t| ≤ e·|t|, and |N′| is |N| up to e. Differences,
/// products and sums are rounded: γ_(d+3) of the magnitude.
bool NearFlat::contains(const double* q) {
  if (is_known_) {
    double value = 0, magnitude = 0, reach = 0;
    for (std::size_t j = 0; j < axes_.size(); ++j) {
      const double t = q[j] - points_[0][j];
      value += normal_.normal()[j] * t;
      magnitude += std::fabs(normal_.normal()[j] * t);
      reach += std::fabs(t);
    }
    const double bound = 1.01 * (normal_.error() * reach + (static_cast<double>(axes_.size()) + 4) *
                                                               kernel::unit_roundoff * magnitude) +
                         kernel::underflow_allowance;
    constexpr double slack = 0x1p-48;  // of the length, the products and the differences below
    const double least = (normal_.length() - normal_.error()) * (1 - slack) * tolerance_,
                 most = (normal_.length() + normal_.error()) * (1 + slack) * tolerance_;
    if (std::fabs(value) + bound < least) return true;
    if (std::fabs(value) - bound > most + kernel::underflow_allowance) return false;
  }
  return is_near_flat(points_, q, dimension_, tolerance_);
}

}  // namespace delone::internal
