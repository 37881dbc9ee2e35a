// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of the corners of clipped regions, each within a certified radius: from binary64, improved in
// pairs of doubles, or from integers.
#include "kernel/double_double.hpp"
#include "kernel/linear_bound.hpp"
#include "voronoi/clipper_limits.hpp"
#include "voronoi/region_clipper.hpp"
#include "voronoi/roundoff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::voronoi {

using namespace clipper_limits;

namespace {

/// Corners with a larger radius than this, in units of the box, get their coordinates from integers.
constexpr double coarse_radius = 0x1p-44;
/// Covers what underflows in a few products of pairs, 2⁻⁸⁹⁰ each.
constexpr double underflow_of_pairs = 1e-260;

}  // namespace

/// With the residual r of the computed solution, |y − ỹ| ≤ |R|·(|r| + its error)/(1 − α); see
/// linear_bound.hpp.
void RegionClipper::find_coordinates(Corner corner) {
  double* y = position(corner);
  radii_[corner] = std::numeric_limits<double>::infinity();
  std::fill(y, y + d_, 0.0);
  if (!is_moderate_) return find_coordinates_exactly(corner);
  // Scaling the rows by powers of two makes all entries smaller than 1. It affects only the certificate.
  for (std::size_t i = 0; i < d_; ++i) {
    const Plane& p = planes_[planes_of(corner)[i]];
    double largest = 0;
    for (const double a : p.a) largest = std::max(largest, std::abs(a));
    if (!(largest > least_extent * least_extent && largest < largest_extent))
      return find_coordinates_exactly(corner);
    const double scale = std::ldexp(1.0, -std::ilogb(largest) - 1);
    for (std::size_t j = 0; j < d_; ++j) matrix_[i * d_ + j] = work_[i * d_ + j] = p.a[j] * scale;
    right_[i] = p.b * scale;
    scales_[i] = scale;
  }
  if (!kernel::approximate_inverse<0>(work_.data(), inverse_.data(), d_))
    return find_coordinates_exactly(corner);
  const double alpha = kernel::inverse_defect<0>(matrix_.data(), inverse_.data(), d_);
  if (!(alpha < 0.5)) return find_coordinates_exactly(corner);
  for (std::size_t j = 0; j < d_; ++j)
    for (std::size_t i = 0; i < d_; ++i) y[j] += inverse_[j * d_ + i] * right_[i];
  constexpr double too_large = 1e8;
  for (const double entry : inverse_)
    if (!(std::abs(entry) < too_large)) return find_coordinates_exactly(corner);
  double radius = 0;
  for (std::size_t i = 0; i < d_; ++i) {
    const Plane& p = planes_[planes_of(corner)[i]];
    double residual = right_[i], magnitude = std::abs(right_[i]);
    for (std::size_t j = 0; j < d_; ++j) {
      residual -= matrix_[i * d_ + j] * y[j];
      magnitude += std::abs(matrix_[i * d_ + j] * y[j]);
    }
    right_[i] =
        std::abs(residual) + static_cast<double>(d_ + 3) * u * magnitude + p.b_error * scales_[i] + underflow;
  }
  for (std::size_t j = 0; j < d_; ++j) {
    double error = 0;
    for (std::size_t i = 0; i < d_; ++i) error += std::abs(inverse_[j * d_ + i]) * right_[i];
    if (!(error <= radius)) radius = error;
  }
  radius *= 1.01 / (1 - alpha);
  if (!(radius < coarse_radius * extent_)) radius = refine(corner, alpha);
  if (!(radius < coarse_radius * extent_)) return find_coordinates_exactly(corner);
  radii_[corner] = radius;
}

/// One step of iterative refinement, y + R·r, whose residual is computed for the sum y + y_low: that is
/// within |R|·(|r| + its error)/(1 − α) of the corner, as above, and rounding it to doubles adds u.
///
/// Entries of bisectors are differences of two coordinates, pairs without error; b is half of a sum of d
/// squares of pairs and a difference of weights. So b is off by 9u² of each square and 6u² in each of d + 1
/// sums. In the residual each product is off by 9u² and each of 2d sums by 6u², all relative to the sum of
/// magnitudes. Where nothing overflows, underflows are as small as above.
double RegionClipper::refine(Corner corner, double alpha) {
  using kernel::DoubleDouble;
  double* const y = position(corner);
  std::vector<double> low(d_, 0.0), bound(d_);
  constexpr double square_roundoff = u * u;
  for (int step = 0; step < 2; ++step) {
    for (std::size_t i = 0; i < d_; ++i) {
      const std::size_t plane = planes_of(corner)[i];
      DoubleDouble b, residual{0, 0};
      double parts = 0;
      const auto subtract = [&](const DoubleDouble& a, std::size_t j) {
        residual = residual - a * DoubleDouble{y[j], 0} - a * DoubleDouble{low[j], 0};
        parts += std::abs(a.high * y[j]) + std::abs(a.high * low[j]);
      };
      if (plane < 2 * d_) {
        const std::size_t axis = plane / 2;
        const bool is_high = plane % 2 == 1;
        b = is_high ? kernel::two_sum(box_.high[axis], -site_.point[axis])
                    : kernel::two_sum(site_.point[axis], -box_.low[axis]);
        parts = std::abs(b.high);
        subtract({is_high ? 1.0 : -1.0, 0}, axis);
      } else if (plane < num_fixed_planes()) {
        const double* const row = halfspace(plane);
        b = {-row[d_], 0};
        parts = std::abs(row[d_]);
        for (std::size_t j = 0; j < d_; ++j) {
          const DoubleDouble product = DoubleDouble{row[j], 0} * DoubleDouble{site_.point[j], 0};
          b = b - product;
          parts += std::abs(product.high);
          subtract({row[j], 0}, j);
        }
      } else {
        const Site& other = others_[other_of_plane_[plane]];
        b = -kernel::two_sum(other.weight, -site_.weight);
        parts = std::abs(b.high);
        for (std::size_t j = 0; j < d_; ++j) {
          const DoubleDouble a = kernel::two_sum(other.point[j], -site_.point[j]);
          b = b + a * a;
          parts += a.high * a.high;
          subtract(a, j);
        }
        b = {b.high / 2, b.low / 2};
      }
      residual = residual + b;
      right_[i] = residual.high * scales_[i];
      bound[i] = std::abs(right_[i]) +
                 1.01 * static_cast<double>(18 * d_ + 40) * (square_roundoff * parts) * scales_[i] +
                 underflow_of_pairs * scales_[i] + underflow;
    }
    if (step == 0)
      for (std::size_t j = 0; j < d_; ++j)
        for (std::size_t i = 0; i < d_; ++i) low[j] += inverse_[j * d_ + i] * right_[i];
  }
  double radius = 0, largest = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    double error = 0;
    for (std::size_t i = 0; i < d_; ++i) error += std::abs(inverse_[j * d_ + i]) * bound[i];
    if (!(error <= radius)) radius = error;
    y[j] += low[j];
    largest = std::max(largest, std::abs(y[j]));
  }
  return 1.01 * (radius / (1 - alpha) + u * largest);
}

/// The corner less the site, in units of 2^grid_.
kernel::Fractions RegionClipper::solve_exactly(Corner corner) {
  std::vector<kernel::Integer> system;
  for (std::size_t i = 0; i < d_; ++i) {
    const auto& row = exact_plane(planes_of(corner)[i]);
    system.insert(system.end(), row.begin(), row.end());
  }
  return kernel::solve_exactly(std::move(system), d_);
}

RegionClipper::ExactCorner RegionClipper::exact_corner(Corner corner) {
  ExactCorner result{solve_exactly(corner), grid_};
  for (std::size_t j = 0; j < d_; ++j)
    result.at.numerators[j] += kernel::scaled_integer(site_.point[j], grid_) * result.at.denominator;
  return result;
}

void RegionClipper::find_coordinates_exactly(Corner corner) {
  const kernel::Fractions solution = solve_exactly(corner);
  double largest = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    position(corner)[j] = kernel::nearest_double(solution.numerators[j], solution.denominator, grid_);
    largest = std::max(largest, std::abs(position(corner)[j]));
  }
  radii_[corner] = u * largest + std::numeric_limits<double>::denorm_min();
}

}  // namespace delone::voronoi
