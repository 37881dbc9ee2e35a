// SPDX-License-Identifier: BSD-3-Clause
// The power-of-two grid that coordinates lie on: what lets a determinant in binary64 be proved to be exactly zero.
#pragma once

#include <algorithm>
#include <bit>
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

/// For each coordinate axis the finest exponent seen: every coordinate included so far is an integer multiple of
/// 2^exponent(axis). Shrinks only.
class Grid {
 public:
  explicit Grid(int ambient) : exponents_(static_cast<std::size_t>(ambient), std::numeric_limits<int>::max()) {}

  void include(const double* point) {
    for (std::size_t j = 0; j < exponents_.size(); ++j) exponents_[j] = std::min(exponents_[j], trailing_exponent(point[j]));
  }
  int exponent(int axis) const { return exponents_[static_cast<std::size_t>(axis)]; }
  int finest() const { return *std::min_element(exponents_.begin(), exponents_.end()); }

 private:
  std::vector<int> exponents_;
};

}  // namespace delone::kernel
