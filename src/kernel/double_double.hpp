// SPDX-License-Identifier: BSD-3-Clause
// Numbers of twice the precision of binary64: the unevaluated sum of a double and the rest, with bounds that
// are proved in docs/predicates.md, "Double-double". Needs no fused multiply-add.
#pragma once

namespace delone::kernel {

/// high + low, with |low| ≤ u·|high|, u the unit roundoff of binary64.
struct DoubleDouble {
  double high, low;
};

/// a + b exactly, barring overflow (Knuth, The Art of Computer Programming 2, section 4.2.2).
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a − b exactly, barring overflow.
inline DoubleDouble two_difference(double a, double b) { return two_sum(a, -b); }

/// Stages that multiply differences leave those that are not below this to exact arithmetic.
inline constexpr double largest_difference = 1e300;

/// a·b exactly, barring underflow and |a|, |b| beyond 2^990 (Dekker 1971, doi:10.1007/BF01397083; Veltkamp).
inline DoubleDouble two_product(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const double product = a * b;
  const double a_scaled = splitter * a, a_high = a_scaled - (a_scaled - a), a_low = a - a_high;
  const double b_scaled = splitter * b, b_high = b_scaled - (b_scaled - b), b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

inline DoubleDouble operator-(const DoubleDouble& x) { return {-x.high, -x.low}; }

/// Off by at most 6u²·(|x| + |y|), which is no bound relative to the sum where x and y cancel.
inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble sum = two_sum(x.high, y.high);
  return two_sum(sum.high, sum.low + (x.low + y.low));
}
inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }

/// Off by at most 9u²·|x·y|, barring underflow.
inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble product = two_product(x.high, y.high);
  const double rest = product.low + (x.high * y.low + x.low * y.high);
  const double high = product.high + rest;
  return {high, rest - (high - product.high)};  // exact, as |rest| ≤ |product.high|
}

}  // namespace delone::kernel
