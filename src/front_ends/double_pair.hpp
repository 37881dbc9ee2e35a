// SPDX-License-Identifier: BSD-3-Clause
// Sums and products of two doubles without error, as a rounded part and the rest.
#pragma once

namespace delone::front_ends {

struct Pair {
  double high, low;
};

/// a + b exactly, barring overflow (Knuth, The Art of Computer Programming 2, section 4.2.2).
inline Pair two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a·b exactly, barring underflow and |a|, |b| beyond 2^990 (Dekker 1971, doi:10.1007/BF01397083; Veltkamp).
inline Pair two_product(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const double product = a * b;
  const double a_scaled = splitter * a, a_high = a_scaled - (a_scaled - a), a_low = a - a_high;
  const double b_scaled = splitter * b, b_high = b_scaled - (b_scaled - b), b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

}  // namespace delone::front_ends
