// SPDX-License-Identifier: BSD-3-Clause
// The power-of-two grid that coordinates lie on: with it, determinants in binary64 can be proved to be
// exactly zero.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace delone::kernel {

/// The exponent of the lowest set bit of a finite x: x is an odd multiple of 2^trailing_exponent(x). For 0: a
/// huge value.
inline int trailing_exponent(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  if (biased == 0) return fraction == 0 ? std::numeric_limits<int>::max() : std::countr_zero(fraction) - 1074;
  return (fraction == 0 ? 52 : std::countr_zero(fraction)) + biased - 1075;
}

/// What is known of the coordinates of a growing set of points: for each axis the finest exponent, so that
/// every coordinate is an integer multiple of 2^exponent(axis), and the range. The same for weights, if
/// points have weights.
class Grid {
 public:
  explicit Grid(int ambient, bool weighted = false)
      : axes_(static_cast<std::size_t>(ambient)), weighted_(weighted) {}

  /// `point`: `ambient` coordinates, then the weight if points have one.
  void include(const double* point) {
    if (note(point)) measure();
  }
  /// All points of a range, point_at(0) … point_at(n − 1): once they are known, the grid is measured once.
  template <class PointAt>
  void include_all(std::size_t n, PointAt point_at) {
    bool changed = false;
    for (std::size_t i = 0; i < n; ++i) changed = note(point_at(i)) || changed;
    if (changed) measure();
  }
  /// Changes whenever any of the following does; 0 as long as there is no point.
  std::uint64_t revision() const { return revision_; }
  int exponent(int axis) const { return axes_[static_cast<std::size_t>(axis)].exponent; }
  int finest() const { return finest_; }
  /// Every |p − q|² − (w_p − w_q) of two points is an integer multiple of 2^lift_exponent().
  int lift_exponent() const { return lift_exponent_; }
  /// Whether every minor of a determinant of differences and lifts is exact in binary64, whatever the points
  /// of the set: a multiple of its grid unit by less than 2^53 (docs/predicates.md, "Small lattices").
  bool is_small() const { return is_small_; }
  /// Whether every minor of a determinant of differences, without lifts, is exact in binary32 as a multiple
  /// of its grid unit, and so are keys in units of the axes. Implies is_small().
  bool is_tiny() const { return is_tiny_; }
  /// The number of units of an axis in 1. REQUIRES is_tiny().
  double per_unit(int axis) const { return axes_[static_cast<std::size_t>(axis)].per_unit; }
  /// The sum of differences of coordinates, in units of the grid, times these is exact in binary32, and
  /// orders points as key_weight() does. REQUIRES is_tiny().
  double tiny_key_weight(int axis) const { return axes_[static_cast<std::size_t>(axis)].tiny_key_weight; }
  /// The sum of the coordinates times these, or of differences of coordinates, is exact in binary64 and
  /// orders points lexicographically: an axis outweighs all later ones. REQUIRES is_small().
  double key_weight(int axis) const { return axes_[static_cast<std::size_t>(axis)].key_weight; }
  /// A number that is exact in binary64 and orders points lexicographically. REQUIRES is_small().
  double lexicographic_key(const double* point) const {
    double key = 0;
    for (const Axis& axis : axes_) key += (*point++ - axis.low) * axis.key_weight;
    return key;
  }

 private:
  static constexpr int unlimited = std::numeric_limits<int>::max();
  /// With `moderate` below: products of 14 entries stay within 2^±1000.
  static constexpr std::size_t most_axes = 12;

  struct Axis {
    int exponent = unlimited;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double key_weight = 0;  // of lexicographic_key(): one unit outweighs all following axes together
    double tiny_key_weight = 0, per_unit = 0;

    /// Returns whether that changed anything.
    bool include(double x) {
      const int lowest_bit = trailing_exponent(x);
      if (lowest_bit >= exponent && x >= low && x <= high) return false;
      *this = {std::min(exponent, lowest_bit), std::min(low, x), std::max(high, x)};
      return true;
    }
  };

  /// Returns whether that changed anything, after which measure() is due.
  bool note(const double* point) {
    bool changed = false;
    for (std::size_t j = 0; j < axes_.size(); ++j) changed = axes_[j].include(point[j]) || changed;
    if (weighted_) changed = weight_.include(point[axes_.size()]) || changed;
    return changed;
  }

  /// log2(n!) for the few dimensions in which a grid can be small.
  static double log2_of_factorial(std::size_t n) {
    static const auto all = [] {
      std::array<double, most_axes + 2> logarithms{};
      for (std::size_t i = 2; i < logarithms.size(); ++i)
        logarithms[i] = logarithms[i - 1] + std::log2(static_cast<double>(i));
      return logarithms;
    }();
    return all[n];
  }

  void measure() {
    ++revision_;
    finest_ = unlimited;
    for (const Axis& axis : axes_) finest_ = std::min(finest_, axis.exponent);
    // Equal weights cancel, whatever grid they lie on.
    const bool weights_differ = weight_.high > weight_.low;
    lift_exponent_ = finest_ == unlimited ? unlimited : 2 * finest_;
    if (weights_differ) lift_exponent_ = std::min(lift_exponent_, weight_.exponent);
    is_tiny_ = false;
    is_small_ = axes_.size() <= most_axes;
    if (!is_small_) return;
    double bits = 0;  // of the product of the columns' largest entries
    int widest = 0;   // bits of the largest difference in units of the finest grid
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
    double lift_bits = 2.0 * widest + std::bit_width(axes_.size() - 1);
    if (weights_differ) {
      const double range = weight_.high - weight_.low;
      if (!std::isfinite(range)) {
        is_small_ = false;
        return;
      }
      const int top = std::ilogb(range) + 1;
      constexpr int moderate = 120;  // that of the squares
      if (top > moderate || weight_.exponent < -moderate) is_small_ = false;
      // A difference of two numbers: of squares below 2^lift_bits units of the square of the finest grid, and
      // of weights.
      if (widest > 0) lift_bits += 2.0 * finest_ - lift_exponent_;
      lift_bits = 1 + std::max(lift_bits, static_cast<double>(top - lift_exponent_));
    }
    bits += lift_bits;
    bits += log2_of_factorial(axes_.size() + 1);
    if (bits > 53) is_small_ = false;
    if (is_small_) weigh_axes();
  }

  void weigh_axes() {
    constexpr double exact = 0x1p24;  // integers up to here
    double keys = 1;                  // the number of different keys of the following axes
    double minors = 1;                // the largest sum of products
    for (std::size_t j = axes_.size(); j-- > 0;) {
      Axis& axis = axes_[j];
      const double largest = axis.high > axis.low ? std::ldexp(axis.high - axis.low, -axis.exponent) : 0;
      axis.tiny_key_weight = keys;
      axis.per_unit = largest > 0 ? std::ldexp(1.0, -axis.exponent) : 1;
      keys *= 2 * largest + 1;
      minors *= static_cast<double>(j + 1) * std::max(largest, 1.0);
    }
    is_tiny_ = keys <= exact && minors <= exact;
    int bits = 0;  // of the keys of the following axes
    for (auto axis = axes_.rbegin(); axis != axes_.rend(); ++axis) {
      axis->key_weight = 0;
      if (!(axis->high > axis->low)) continue;
      axis->key_weight = std::ldexp(1.0, bits - axis->exponent);
      bits += std::ilogb(axis->high - axis->low) + 1 - axis->exponent + 1;
    }
  }

  std::vector<Axis> axes_;
  bool weighted_;
  Axis weight_;
  std::uint64_t revision_ = 0;
  int finest_ = unlimited;
  int lift_exponent_ = unlimited;
  bool is_small_ = false, is_tiny_ = false;
};

}  // namespace delone::kernel
