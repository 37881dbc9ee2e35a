// SPDX-License-Identifier: BSD-3-Clause
// The frame of the cached functionals: coordinates relative to the centre of a box, scaled by powers of two
// to [−1, 1].
#pragma once

#include "kernel/flat.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace delone::geometry {

/// A box in R^ambient and the affine map x ↦ ((x_j − c_j)·s_j)_j, which sends it into [−1, 1]^ambient; for
/// weighted points also a range of weights. Each image coordinate is off by at most one rounding of a number
/// of magnitude ≤ 1, as s_j is a power of two. The lift is Σ((x_j − c_j)·s)² + (w_0 − w)·s² with one s for
/// all axes and w_0 the heaviest weight of the range: at least 0, at most largest_lift(), relative error
/// (ambient + 4) roundings. Of furthest points it is −Σ((x_j − c_j)·s)².
class Frame {
 public:
  Frame() = default;

  /// The frame of the box [low, high]; with weights, the last entries are the range of the weights. REQUIRES
  /// finite bounds, low ≤ high.
  Frame(std::vector<double> low, std::vector<double> high, kernel::RowForm form = kernel::RowForm::point)
      : low_(std::move(low)),
        high_(std::move(high)),
        form_(form),
        sign_(form == kernel::RowForm::furthest_point ? -1 : 1) {
    const bool weighted = form == kernel::RowForm::weighted_point;
    int largest = smallest_exponent;
    const auto ambient = low_.size() - (weighted ? 1 : 0);
    for (std::size_t j = 0; j < ambient; ++j) {
      const double center = low_[j] / 2 + high_[j] / 2;
      int exponent = smallest_exponent;
      if (const double half = std::max(high_[j] - center, center - low_[j]); half > 0)
        std::frexp(half, &exponent);
      exponent = std::max(exponent, smallest_exponent);
      largest = std::max(largest, exponent);
      center_.push_back(center);
      scale_.push_back(std::ldexp(1.0, -exponent));
    }
    if (weighted && high_.back() > low_.back()) {
      int exponent;  // the range is below 2^exponent, and must not exceed 1 after division by the square of
                     // 2^largest
      if (const double range = high_.back() - low_.back(); std::isfinite(range)) {
        std::frexp(range, &exponent);
      } else {
        std::frexp(high_.back() / 2 - low_.back() / 2, &exponent);
        ++exponent;
      }
      largest = std::max(largest, (exponent + (exponent > 0 ? 1 : 0)) / 2);
      weights_differ_ = true;
    }
    lift_scale_ = std::ldexp(1.0, -largest);
    // Weights whose difference could overflow are scaled first; in a frame of scale above 1 their range is
    // below 1.
    weight_scale_ = std::min(lift_scale_, 1.0);
    if (weighted) heaviest_ = high_.back() * weight_scale_;
  }

  /// Whether the box contains x, and the range its weight: the bounds on images and lifts hold for such x
  /// only.
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
  /// Per axis, what is subtracted from coordinates and what they are then multiplied with.
  const std::vector<double>& center() const { return center_; }
  const std::vector<double>& scale() const { return scale_; }
  /// The exponents of these powers of two.
  int scale_exponent(int axis) const { return std::ilogb(scale_[static_cast<std::size_t>(axis)]); }
  int lift_scale_exponent() const { return std::ilogb(lift_scale_); }
  double lift(const double* x) const {
    double sum = 0;
    for (std::size_t j = 0; j < center_.size(); ++j) {
      const double t = (x[j] - center_[j]) * lift_scale_;
      sum += t * t;
    }
    if (weights_differ_)
      sum += (heaviest_ - x[center_.size()] * weight_scale_) * (lift_scale_ / weight_scale_) * lift_scale_;
    return sign_ * sum;
  }
  /// The magnitudes of lifts are at most that.
  double largest_lift() const { return ambient() + (weights_differ_ ? 1 : 0); }

  /// The bounds of the box, and then of the weights if there are any.
  const std::vector<double>& low() const { return low_; }
  const std::vector<double>& high() const { return high_; }
  int ambient() const { return static_cast<int>(center_.size()); }
  kernel::RowForm form() const { return form_; }

 private:
  /// Boxes narrower than 2^smallest_exponent are not scaled up further: the scale would overflow.
  static constexpr int smallest_exponent = -1000;

  std::vector<double> low_, high_, center_, scale_;
  double lift_scale_ = 1, weight_scale_ = 1;
  double heaviest_ = 0;  // times weight_scale_
  kernel::RowForm form_ = kernel::RowForm::point;
  double sign_ = 1;  // of squares in a lift
  bool weights_differ_ = false;
};

}  // namespace delone::geometry
