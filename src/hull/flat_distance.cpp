// SPDX-License-Identifier: BSD-3-Clause
#include "hull/flat_distance.hpp"

#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace delone::hull {
namespace {

using kernel::Integer;

/// Of sums and products, relative to the magnitudes of their terms.
constexpr double rounding_of_pairs = 9 * kernel::unit_roundoff * kernel::unit_roundoff;

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

/// The entries of the normal are minors of the edges, which are pairs without error, scaled to at most 1:
/// each is off by at most 9u² times m(m+1)/2 times the permanent of the magnitudes, m = d − 1, and by what
/// underflows. The last row of the table is not used.
void PreciseNormal::set(std::span<const double* const> points, int dimension) {
  constexpr std::size_t most_columns = 10;
  const auto d = static_cast<std::size_t>(dimension);
  scale_ = 0;
  base_ = points[0];
  if (points.size() != d || d > most_columns) return;
  double largest = 0;
  for (std::size_t i = 1; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::fabs(points[i][j] - base_[j]));
  if (!(largest > 0x1p-400 && largest < 0x1p400)) return;
  const double scale = std::ldexp(1.0, -std::ilogb(largest) - 1);
  std::vector<kernel::DoubleDouble> edges(d * d, kernel::DoubleDouble{0, 0});
  std::vector<kernel::Magnitude> magnitudes(d * d, kernel::Magnitude{0});
  for (std::size_t i = 1; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j) {
      const kernel::DoubleDouble edge = kernel::two_sum(points[i][j], -base_[j]);
      edges[(i - 1) * d + j] = {edge.high * scale, edge.low * scale};
      magnitudes[(i - 1) * d + j].value = std::fabs(edge.high * scale);
    }
  const std::size_t all = (std::size_t{1} << d) - 1;
  minors_.resize(all + 1);
  parts_.resize(all + 1);
  kernel::determinant_by_minors(edges.data(), d, minors_.data());
  kernel::determinant_by_minors(magnitudes.data(), d, parts_.data());
  normal_.resize(d);
  errors_.resize(d);
  const auto m = static_cast<double>(d - 1);
  double square = 0, error_square = 0;
  for (std::size_t j = 0; j < d; ++j) {
    const std::size_t others = all & ~(std::size_t{1} << j);
    normal_[j] = d == 1 ? kernel::DoubleDouble{1, 0} : minors_[others];
    if (j % 2 != 0) normal_[j] = -normal_[j];
    errors_[j] = d == 1 ? 0 : 1.01 * m * (m + 1) / 2 * rounding_of_pairs * parts_[others].value + 0x1p-800;
    square += normal_[j].high * normal_[j].high;
    error_square += errors_[j] * errors_[j];
  }
  const double length = std::sqrt(square), error = 1.01 * std::sqrt(error_square) + 0x1p-500;
  constexpr double slack = 0x1p-46;  // of the low parts, the length and the products with it
  if (!(length > 0x1p-400 && error < length / 8)) return;
  least_length_ = (length - error) * (1 - slack);
  most_length_ = (length + error) * (1 + slack);
  scale_ = scale;
}

/// Products and sums of pairs are off by 9u² each, relative to their terms.
std::optional<bool> PreciseNormal::is_near(const double* q, double tolerance) const {
  if (scale_ == 0 || !(tolerance * scale_ > 0x1p-900)) return std::nullopt;
  kernel::DoubleDouble value{0, 0};
  double parts = 0, error = 0x1p-800;
  for (std::size_t j = 0; j < normal_.size(); ++j) {
    const kernel::DoubleDouble exact = kernel::two_sum(q[j], -base_[j]);
    const kernel::DoubleDouble t{exact.high * scale_, exact.low * scale_};
    if (!(std::fabs(t.high) < 0x1p32)) return std::nullopt;
    value = value + normal_[j] * t;
    parts += std::fabs(normal_[j].high * t.high);
    error += errors_[j] * std::fabs(t.high);
  }
  const double distance = std::fabs(value.high),
               bound =
                   1.01 * (error + (static_cast<double>(normal_.size()) + 2) * rounding_of_pairs * parts) +
                   4 * kernel::unit_roundoff * distance;
  if (distance + bound < least_length_ * (tolerance * scale_)) return true;
  if (distance - bound > most_length_ * (tolerance * scale_)) return false;
  return std::nullopt;
}

NearFlat::NearFlat(int dimension, int k, double tolerance)
    : dimension_(dimension), tolerance_(tolerance), normal_(k), axes_(static_cast<std::size_t>(dimension)) {
  std::iota(axes_.begin(), axes_.end(), 0);
}

void NearFlat::set(std::span<const double* const> points) {
  points_.assign(points.begin(), points.end());
  has_precise_ = false;
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
  if (!std::exchange(has_precise_, true)) precise_.set(points_, dimension_);
  if (const auto near = precise_.is_near(q, tolerance_)) return *near;
  return is_near_flat(points_, q, dimension_, tolerance_);
}

}  // namespace delone::hull
