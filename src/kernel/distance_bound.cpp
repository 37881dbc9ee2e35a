// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/distance_bound.hpp"

#include "base/length.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::kernel {
namespace {

constexpr double u = unit_roundoff, least = std::numeric_limits<double>::denorm_min();

/// Above the length of the vector with these components, for any d ≥ 1.
template <class Component>
double length_above(std::size_t d, Component component) {
  const double length = internal::length_of(d, component);
  const double enlarged = length * (1 + 4 * static_cast<double>(d) * u);
  return length > 0 && length < std::numeric_limits<double>::min() ? enlarged + least : enlarged;
}

}  // namespace

double distance_bound(const double* x, const double* y, std::size_t d, double slack) {
  return length_above(d, [&](std::size_t j) {
    const double difference = std::abs(x[j] - y[j]);
    return difference + 1.01 * (3 * u * difference + slack * (std::abs(x[j]) + std::abs(y[j]))) +
           (slack > 0 ? 2 * least : 0);
  });
}

void FlatDistance::set_flat(std::span<const double* const> points, std::size_t d, double slack) {
  points_.assign(points.begin(), points.end());
  d_ = d;
  slack_ = slack;
  const std::size_t m = points.size() - 1;
  double largest = 0;
  for (std::size_t i = 1; i <= m; ++i)
    for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::abs(points[i][j] - points[0][j]));
  // Lengths are near 1, so that no square overflows or underflows.
  scale_ = largest > 0 && std::isfinite(largest)
               ? std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1020, 1020))
               : 1;
  basis_.assign(m * d, 0.0);
  combinations_.assign(m * m, 0.0);
  for (std::size_t i = 0; i < m; ++i) {
    double* const b = basis_.data() + i * d;
    double* const c = combinations_.data() + i * m;
    for (std::size_t j = 0; j < d; ++j) b[j] = (points[i + 1][j] - points[0][j]) * scale_;
    c[i] = 1;
    double before = 0, after = 0;
    for (std::size_t j = 0; j < d; ++j) before += b[j] * b[j];
    for (int pass = 0; pass < 2; ++pass)  // a second pass makes up for cancellation in the first
      for (std::size_t e = 0; e < i; ++e) {
        double dot = 0;
        for (std::size_t j = 0; j < d; ++j) dot += b[j] * basis_[e * d + j];
        for (std::size_t j = 0; j < d; ++j) b[j] -= dot * basis_[e * d + j];
        for (std::size_t l = 0; l <= e; ++l) c[l] -= dot * combinations_[e * m + l];
      }
    for (std::size_t j = 0; j < d; ++j) after += b[j] * b[j];
    constexpr double dependent = 0x1p-80;  // the point adds no direction that rounding errors leave known
    const double length = std::sqrt(after);
    const bool is_new = after > dependent * before;
    for (std::size_t j = 0; j < d; ++j) b[j] = is_new ? b[j] / length : 0;
    for (std::size_t l = 0; l < m; ++l) c[l] = is_new ? c[l] / length : 0;
  }
}

double FlatDistance::bound_with(const double* x, bool is_segment) {
  const std::size_t m = points_.size() - 1;
  const double* const origin = points_[0];
  factors_.assign(m, 0.0);
  rest_.resize(d_);
  for (std::size_t j = 0; j < d_; ++j) rest_[j] = x[j] - origin[j];
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < m; ++i) {
      double dot = 0;
      for (std::size_t j = 0; j < d_; ++j) dot += rest_[j] * scale_ * basis_[i * d_ + j];
      for (std::size_t l = 0; l <= i; ++l) factors_[l] += dot * combinations_[i * m + l];
    }
    if (is_segment) factors_[0] = std::clamp(factors_[0], 0.0, 1.0);
    if (!std::all_of(factors_.begin(), factors_.end(), [](double a) { return std::isfinite(a); }))
      factors_.assign(m, 0.0);
    for (std::size_t j = 0; j < d_; ++j) {
      rest_[j] = x[j] - origin[j];
      for (std::size_t i = 0; i < m; ++i) rest_[j] -= factors_[i] * (points_[i + 1][j] - origin[j]);
    }
  }
  const double terms = static_cast<double>(m) + 1;
  return length_above(d_, [&](std::size_t j) {
    double size = std::abs(x[j] - origin[j]), offset = std::abs(x[j]) + std::abs(origin[j]), tiny = 2 * terms;
    for (std::size_t i = 0; i < m; ++i) {
      const double a = std::abs(factors_[i]);
      size += a * std::abs(points_[i + 1][j] - origin[j]);
      offset += a * (std::abs(points_[i + 1][j]) + std::abs(origin[j]));
      tiny += 2 * a;
    }
    const double error = 1.01 * ((terms + 2) * u * size + slack_ * offset) + tiny * least;
    return std::abs(rest_[j]) + error;
  });
}

}  // namespace delone::kernel
