// SPDX-License-Identifier: BSD-3-Clause
// With barycentric coordinates w, none off by more than ε, and a vertex b, the height of the plane is
//
//     h_b + Σ w_i·(h_i − h_b),     off by at most   ε·Σ |h_i − h_b| + (n+6)u·Σ |w_i·(h_i − h_b)|
//
// where i is one of the n other vertices of the face that contains q: each term carries the rounding of its
// difference and its product, and of n + 1 sums. Heights are scaled by a power of two to at most 1/4,
// exactly, so nothing overflows, and underflow stays far below the absolute term 10⁻²⁹⁰. The factor 1.01
// covers the rounding of the bound.
#include "hull/cell_height.hpp"

#include "kernel/barycentric.hpp"
#include "kernel/determinant.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::hull {
namespace {

using Points = std::span<const double* const>;

std::vector<int> first_axes(std::size_t n) {
  std::vector<int> axes(n);
  std::iota(axes.begin(), axes.end(), 0);
  return axes;
}

constexpr double least_exact = 0x1p-900;  // scaled numbers below it have been rounded

/// A sum with a bound on its error, both scaled.
struct BoundedSum {
  double value = 0, error = std::numeric_limits<double>::infinity();
};

/// The plane of a cell in binary64, seen from the vertex of the largest weight.
class CellInBinary64 {
 public:
  /// `top`: another height, of the point that is compared with the plane.
  CellInBinary64(Points points, std::span<const unsigned char> on_face, const double* q, double top) {
    const std::size_t n = points.size() - 1;
    double largest = std::fabs(top);
    for (std::size_t i = 0; i <= n; ++i)
      if (on_face[i] != 0) largest = std::max(largest, std::fabs(points[i][n]));
    exponent_ = kernel::exponent_to_a_quarter(largest);
    weight_error_ = kernel::certified_barycentric(points, first_axes(n), q, weights_);
    if (!(weight_error_ < 1)) return;
    heights_.assign(n + 1, 0.0);
    for (std::size_t i = 0; i <= n; ++i) {
      if (on_face[i] == 0) continue;
      heights_[i] = scaled(points[i][n]);
      if (on_face[base_] == 0 || weights_[i] > weights_[base_]) base_ = i;
    }
    for (std::size_t i = 0; i <= n; ++i)
      if (on_face[i] == 0) heights_[i] = heights_[base_];  // has no weight
    top_ = scaled(top);
  }

  double base() const { return heights_[base_]; }
  double scaled(double x) {
    const double y = std::ldexp(x, exponent_);
    if (x != 0 && std::fabs(y) < least_exact) is_exact_ = false;
    return y;
  }
  int exponent() const { return exponent_; }
  double unscaled(double y) const { return std::ldexp(y, -exponent_); }

  /// The height of the plane less that of the base.
  BoundedSum over_base() const { return sum(0.0, -1.0); }
  /// The height of the other point less that of the plane.
  BoundedSum of_top() const { return heights_.empty() ? BoundedSum() : sum(top_ - base(), 1.0); }

 private:
  BoundedSum sum(double first, double sign) const {
    if (heights_.empty() || !is_exact_) return {};
    double value = first, parts = std::fabs(first), spread = 0;
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      const double difference = heights_[i] - base();  // 0 for the base
      const double term = weights_[i] * difference;
      value -= sign * term;
      parts += std::fabs(term);
      spread += std::fabs(difference);
    }
    const double roundings = static_cast<double>(heights_.size() + 5) * kernel::unit_roundoff;
    return {value, 1.01 * (weight_error_ * spread + roundings * parts) + 1e-290};
  }

  int exponent_ = 0;
  bool is_exact_ = true;
  std::size_t base_ = 0;
  double weight_error_ = 0, top_ = 0;
  std::vector<double> weights_, heights_;  // no heights: nothing is known
};

}  // namespace

HeightOfPlane::HeightOfPlane(Points points, const double* q, int width) {
  const auto n = static_cast<std::size_t>(width) - 1;
  grid_ = std::min(0, kernel::trailing_exponent(q[n]));
  for (const double* p : points) grid_ = std::min(grid_, kernel::trailing_exponent(p[n]));
  const kernel::Fractions weights = kernel::exact_barycentric(points, first_axes(n), q);
  height_ = -weights.denominator * kernel::scaled_integer(q[n], grid_);
  for (std::size_t i = 0; i <= n; ++i)
    height_ += weights.numerators[i] * kernel::scaled_integer(points[i][n], grid_);
  denominator_ = weights.denominator;
  if (denominator_ > 0) return;
  height_ = -height_;
  denominator_ = -denominator_;
}

bool HeightOfPlane::magnitude_exceeds(double x) const {
  return compare(height_ < 0 ? kernel::Integer(-height_) : height_, x) > 0;
}
double HeightOfPlane::nearest() const { return kernel::nearest_double(height_, denominator_, grid_); }
double HeightOfPlane::above() const {
  return height_ > 0 ? kernel::double_above(height_, denominator_, grid_) : 0.0;
}

int HeightOfPlane::compare(const kernel::Integer& height, double x) const {
  const int grid = std::min(grid_, kernel::trailing_exponent(x));
  const kernel::Integer left = height << (grid_ - grid);
  return left.compare(kernel::scaled_integer(x, grid) * denominator_);
}

double height_over_cell(Points points, std::span<const unsigned char> on_face, const double* q, int width) {
  const auto n = static_cast<std::size_t>(width) - 1;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i <= n; ++i) {
    if (on_face[i] == 0) continue;
    low = std::min(low, points[i][n]);
    high = std::max(high, points[i][n]);
  }
  if (low == high) return low;
  CellInBinary64 cell(points, on_face, q, 0.0);
  const BoundedSum sum = cell.over_base();
  if (sum.error <= largest_height_error * (cell.scaled(high) - cell.scaled(low)))
    return std::clamp(cell.unscaled(cell.base() + sum.value), low, high);
  std::vector<double> ground(q, q + n);
  ground.push_back(0.0);
  return HeightOfPlane(points, ground.data(), width).nearest();
}

double height_above_cell(Points points, std::span<const unsigned char> on_face, const double* q, int width,
                         Sign sign, double tolerance) {
  if (sign == Sign::zero) return 0;
  const auto signed_by = [sign](double magnitude) {
    magnitude = std::max(magnitude, std::numeric_limits<double>::denorm_min());
    return sign == Sign::positive ? magnitude : -magnitude;
  };
  CellInBinary64 cell(points, on_face, q, q[static_cast<std::size_t>(width) - 1]);
  const BoundedSum sum = cell.of_top();
  const double magnitude = std::fabs(sum.value), limit = std::ldexp(tolerance, cell.exponent());
  if (limit >= least_exact && magnitude + sum.error <= limit) return 0;
  const bool is_above = tolerance == 0 || magnitude - sum.error > std::max(limit, least_exact);
  if (is_above && sum.error <= largest_height_error * magnitude) return signed_by(cell.unscaled(magnitude));
  const HeightOfPlane exact(points, q, width);
  return exact.magnitude_exceeds(tolerance) ? signed_by(std::fabs(exact.nearest())) : 0.0;
}

}  // namespace delone::hull
