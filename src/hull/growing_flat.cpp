// SPDX-License-Identifier: BSD-3-Clause
#include "hull/growing_flat.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace delone::hull {

GrowingFlat::GrowingFlat(std::vector<const double*> points, int dimension)
    : points_(std::move(points)), d_(static_cast<std::size_t>(dimension)), basis_{points_[0]} {
  // Divided by 4, and scaled to at most 1, so that nothing overflows.
  double largest = 0;
  rests_.reserve(points_.size() * d_);
  for (const double* p : points_)
    for (std::size_t j = 0; j < d_; ++j) {
      rests_.push_back(p[j] / 4 - points_[0][j] / 4);
      largest = std::max(largest, std::fabs(rests_.back()));
    }
  if (largest > 0) {
    const int exponent = -std::ilogb(largest);
    const bool has_scale = std::abs(exponent) < 1000;  // the same as ldexp(), faster
    const double scale = has_scale ? std::ldexp(1.0, exponent) : 0;
    for (double& x : rests_) x = has_scale ? x * scale : std::ldexp(x, exponent);
  }
  find_farthest();
}

void GrowingFlat::grow() {
  basis_.push_back(farthest());
  std::vector<double> unit(rests_.begin() + static_cast<std::ptrdiff_t>(farthest_ * d_),
                           rests_.begin() + static_cast<std::ptrdiff_t>((farthest_ + 1) * d_));
  const double length = std::sqrt(std::inner_product(unit.begin(), unit.end(), unit.begin(), 0.0));
  if (!(length > 0)) return;
  for (double& x : unit) x /= length;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    double part = 0;
    for (std::size_t j = 0; j < d_; ++j) part += unit[j] * rests_[i * d_ + j];
    for (std::size_t j = 0; j < d_; ++j) rests_[i * d_ + j] -= part * unit[j];
  }
  find_farthest();
}

std::vector<int> GrowingFlat::axes() const {
  std::vector<int> axes;
  std::vector<double> edges;
  for (std::size_t i = 1; i < basis_.size(); ++i)
    for (std::size_t j = 0; j < d_; ++j) edges.push_back(basis_[i][j] / 4 - basis_[0][j] / 4);
  const std::size_t k = basis_.size() - 1;
  std::vector<char> is_done(k, 0);
  for (std::size_t step = 0; step < k; ++step) {
    std::size_t row = 0, column = 0;
    double largest = -1;
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < d_ && is_done[i] == 0; ++j)
        if (std::find(axes.begin(), axes.end(), static_cast<int>(j)) == axes.end() &&
            std::fabs(edges[i * d_ + j]) > largest) {
          largest = std::fabs(edges[i * d_ + j]);
          row = i, column = j;
        }
    is_done[row] = 1;
    axes.push_back(static_cast<int>(column));
    for (std::size_t i = 0; i < k && largest > 0; ++i) {
      if (is_done[i] != 0) continue;
      const double factor = edges[i * d_ + column] / edges[row * d_ + column];
      for (std::size_t j = 0; j < d_; ++j) edges[i * d_ + j] -= factor * edges[row * d_ + j];
    }
  }
  std::sort(axes.begin(), axes.end());
  return axes;
}

void GrowingFlat::find_farthest() {
  double largest = -1;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    double square = 0;
    for (std::size_t j = 0; j < d_; ++j) square += rests_[i * d_ + j] * rests_[i * d_ + j];
    if (square > largest) largest = square, farthest_ = i;
  }
}

}  // namespace delone::hull
