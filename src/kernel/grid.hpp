// SPDX-License-Identifier: BSD-3-Clause
// The power-of-two grid that coordinates lie on: what lets a determinant in binary64 be proved to be exactly zero.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace delone::kernel {

/// The exponent of the lowest set bit of a finite x: x is an odd multiple of 2^trailing_exponent(x). For 0: a huge value.
inline int trailing_exponent(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  if (biased == 0) return fraction == 0 ? std::numeric_limits<int>::max() : std::countr_zero(fraction) - 1074;
  return (fraction == 0 ? 52 : std::countr_zero(fraction)) + biased - 1075;
}

/// What a growing set of points is known to lie on: for each coordinate axis the finest exponent seen, so that every coordinate
/// is an integer multiple of 2^exponent(axis), and the range of the axis.
class Grid {
 public:
  explicit Grid(int ambient) : axes_(static_cast<std::size_t>(ambient)) {}

  void include(const double* point) {
    bool changed = false;
    for (std::size_t j = 0; j < axes_.size(); ++j) {
      Axis& axis = axes_[j];
      const int exponent = trailing_exponent(point[j]);
      if (exponent >= axis.exponent && point[j] >= axis.low && point[j] <= axis.high) continue;
      axis = {std::min(axis.exponent, exponent), std::min(axis.low, point[j]), std::max(axis.high, point[j])};
      changed = true;
    }
    if (changed) measure();
  }
  int exponent(int axis) const { return axes_[static_cast<std::size_t>(axis)].exponent; }
  int finest() const { return finest_; }
  /// Whether every minor of a determinant of differences and lifts is exact in binary64, whatever the points of the set:
  /// a multiple of its grid unit by less than 2^53 (docs/predicates.md, "Small lattices").
  bool is_small() const { return is_small_; }

 private:
  struct Axis {
    int exponent = std::numeric_limits<int>::max();
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
  };

  void measure() {
    finest_ = std::numeric_limits<int>::max();
    for (const Axis& axis : axes_) finest_ = std::min(finest_, axis.exponent);
    is_small_ = axes_.size() <= 12;  // with `moderate` below: products of 14 entries stay within 2^±1000
    double bits = 0;                 // of the product of the columns' largest entries
    int widest = 0;                  // bits of the largest difference in units of the finest grid
    for (const Axis& axis : axes_) {
      if (!(axis.high > axis.low)) continue;
      const double range = axis.high - axis.low;
      if (!std::isfinite(range)) {
        is_small_ = false;
        return;
      }
      const int top = std::ilogb(range) + 1;  // differences are below 2^top
      constexpr int moderate = 60;            // no product of so few entries overflows or underflows
      if (top > moderate || axis.exponent < -moderate) is_small_ = false;
      bits += top - axis.exponent;
      widest = std::max(widest, top - finest_);
    }
    bits += 2.0 * widest + std::ceil(std::log2(static_cast<double>(axes_.size())));
    for (std::size_t i = 2; i <= axes_.size() + 1; ++i) bits += std::log2(static_cast<double>(i));  // terms of a determinant
    if (bits > 53) is_small_ = false;
  }

  std::vector<Axis> axes_;
  int finest_ = std::numeric_limits<int>::max();
  bool is_small_ = false;
};

}  // namespace delone::kernel
