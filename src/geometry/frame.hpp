// SPDX-License-Identifier: BSD-3-Clause
// The frame of the cached functionals: coordinates relative to the centre of a box, scaled by powers of two to [−1, 1].
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace delone::geometry {

/// A box in R^ambient and the affine map x ↦ ((x_j − c_j)·s_j)_j, which sends it into [−1, 1]^ambient.
/// Each image coordinate is off by at most one rounding of a number of magnitude ≤ 1, as s_j is a power of two. The lift is
/// Σ((x_j − c_j)·s)² with one s for all axes, at most `ambient`, relative error (ambient + 3) roundings.
class Frame {
 public:
  Frame() = default;

  /// The frame of the box [low, high]. REQUIRES finite bounds, low ≤ high.
  Frame(std::vector<double> low, std::vector<double> high) : low_(std::move(low)), high_(std::move(high)) {
    int largest = smallest_exponent;
    for (std::size_t j = 0; j < low_.size(); ++j) {
      const double center = low_[j] / 2 + high_[j] / 2;
      int exponent = smallest_exponent;
      if (const double half = std::max(high_[j] - center, center - low_[j]); half > 0) std::frexp(half, &exponent);
      exponent = std::max(exponent, smallest_exponent);
      largest = std::max(largest, exponent);
      center_.push_back(center);
      scale_.push_back(std::ldexp(1.0, -exponent));
    }
    lift_scale_ = std::ldexp(1.0, -largest);
  }

  /// Whether the box contains x: the bounds on images and lifts hold for such x only.
  bool contains(const double* x) const {
    for (std::size_t j = 0; j < low_.size(); ++j)
      if (!(low_[j] <= x[j] && x[j] <= high_[j])) return false;
    return true;
  }

  double image(const double* x, int axis) const {
    const auto j = static_cast<std::size_t>(axis);
    return (x[j] - center_[j]) * scale_[j];
  }
  /// How many times as long a unit of the lift's metric is as one of the image along an axis, s_j/s.
  double extent_ratio(int axis) const { return scale_[static_cast<std::size_t>(axis)] / lift_scale_; }
  double lift_scale() const { return lift_scale_; }
  double lift(const double* x) const {
    double sum = 0;
    for (std::size_t j = 0; j < center_.size(); ++j) {
      const double t = (x[j] - center_[j]) * lift_scale_;
      sum += t * t;
    }
    return sum;
  }

  const std::vector<double>& low() const { return low_; }
  const std::vector<double>& high() const { return high_; }
  int ambient() const { return static_cast<int>(low_.size()); }

 private:
  /// Boxes narrower than 2^smallest_exponent are not scaled up further: the scale would overflow.
  static constexpr int smallest_exponent = -1000;

  std::vector<double> low_, high_, center_, scale_;
  double lift_scale_ = 1;
};

}  // namespace delone::geometry
