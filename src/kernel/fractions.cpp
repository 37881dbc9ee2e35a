// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/fractions.hpp"

#include "base/infinity.hpp"
#include "base/progress_meter.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace delone::kernel {

namespace mp = boost::multiprecision;

int square_exponent(double x) { return x == 0 ? trailing_exponent(x) : trailing_exponent(x) >> 1; }

Integer scaled_integer(double x, int grid) {
  if (x == 0) return 0;
  const int exponent = trailing_exponent(x);
  const auto odd = static_cast<std::int64_t>(std::ldexp(x, -exponent));
  return Integer(odd) << (exponent - grid);
}

double nearest_double(Integer numerator, Integer denominator, int exponent) {
  if (numerator == 0) return 0;
  const bool negative = (numerator < 0) != (denominator < 0);
  numerator = mp::abs(numerator);
  denominator = mp::abs(denominator);
  // A quotient of 64 to 66 bits, its last bit set if the remainder is not 0, is enough to round correctly to
  // at most 53 bits.
  const int shift = 65 - (static_cast<int>(mp::msb(numerator)) - static_cast<int>(mp::msb(denominator)));
  if (shift >= 0)
    numerator <<= shift;
  else
    denominator <<= -shift;
  Integer quotient, remainder;
  mp::divide_qr(numerator, denominator, quotient, remainder);
  if (remainder != 0) mp::bit_set(quotient, 0);
  const int last = exponent - shift;  // the weight of the quotient's last bit is 2^last
  const int bits = static_cast<int>(mp::msb(quotient)) + 1;
  const int precision = std::min(53, bits + last + 1074);  // fewer below the normal range
  if (precision < 0) return 0;
  const int dropped = bits - precision;
  Integer kept = quotient >> dropped;
  const Integer rest = quotient - (kept << dropped), half = Integer(1) << (dropped - 1);
  if (rest > half || (rest == half && mp::bit_test(kept, 0))) ++kept;
  const double magnitude = std::ldexp(static_cast<double>(static_cast<std::int64_t>(kept)), dropped + last);
  return magnitude == 0 ? 0 : negative ? -magnitude : magnitude;
}

double double_above(const Integer& numerator, const Integer& denominator, int exponent) {
  using internal::infinity;
  const double nearest = nearest_double(numerator, denominator, exponent);
  if (nearest == infinity) return nearest;
  if (nearest == -infinity) return std::nextafter(nearest, infinity);
  const int grid = std::min(exponent, nearest == 0 ? exponent : trailing_exponent(nearest));
  const Integer scaled = scaled_integer(nearest, grid) * mp::abs(denominator);
  const Integer exact = (denominator < 0 ? Integer(-numerator) : numerator) << (exponent - grid);
  return scaled >= exact ? nearest : std::nextafter(nearest, infinity) + 0.0;
}

double root_above(Integer numerator, Integer denominator, int exponent) {
  if (numerator == 0) return 0;
  numerator = mp::abs(numerator);
  denominator = mp::abs(denominator);
  int shift = static_cast<int>(mp::msb(numerator)) - static_cast<int>(mp::msb(denominator));
  if (shift % 2 != 0) --shift;
  // Of the quotient times 2^−shift, which is between 1/2 and 4; off by one unit in the last place at most.
  double root = std::nextafter(std::sqrt(nearest_double(numerator, denominator, -shift)), 0.0);
  constexpr int grid = -60;  // root² ≥ numerator/denominator·2^−shift, in integers
  (shift < 0 ? numerator : denominator) <<= std::abs(shift);
  numerator <<= -2 * grid;
  for (;; root = std::nextafter(root, 3.0)) {
    const Integer scaled = scaled_integer(root, grid);
    if (scaled * scaled * denominator >= numerator) break;
  }
  // Below the normal range ldexp() rounds; a double of that range that is not below the root is not below
  // this one, either.
  const int scale = shift / 2 + exponent;
  const double result = std::ldexp(root, scale);
  return std::ldexp(result, -scale) < root ? std::nextafter(result, 1.0) : result;
}

Integer exact_determinant(std::vector<Integer> a, std::size_t n) {
  Integer previous(1);
  bool negate = false;
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (pivot < n && a[pivot * n + s] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != s) {
      for (std::size_t c = s; c < n; ++c) std::swap(a[pivot * n + c], a[s * n + c]);
      negate = !negate;
    }
    for (std::size_t r = s + 1; r < n; ++r) {
      internal::cancellation_point();
      for (std::size_t c = s + 1; c < n; ++c)
        a[r * n + c] = (a[r * n + c] * a[s * n + s] - a[r * n + s] * a[s * n + c]) / previous;
    }
    previous = a[s * n + s];
  }
  return negate ? Integer(-previous) : previous;
}

Fractions solve_exactly(std::vector<Integer> augmented, std::size_t n) {
  // Fraction-free Gauss–Jordan: after step s every entry is a minor, so the divisions are exact; at the end
  // the matrix is diagonal with the determinant in every place.
  const std::size_t width = n + 1;
  auto& a = augmented;
  Integer previous(1);
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (pivot < n && a[pivot * width + s] == 0) ++pivot;
    if (pivot == n) return {.numerators = {}, .denominator = 0};
    if (pivot != s)
      for (std::size_t c = 0; c < width; ++c) {
        std::swap(a[pivot * width + c], a[s * width + c]);
        a[s * width + c] = -a[s * width + c];  // keeps the determinant
      }
    const Integer p = a[s * width + s];
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s) continue;
      internal::cancellation_point();
      const Integer factor = a[r * width + s];
      for (std::size_t c = s; c < width; ++c)
        a[r * width + c] = (a[r * width + c] * p - factor * a[s * width + c]) / previous;
      if (r < s) a[r * width + r] = p;
    }
    previous = p;
  }
  Fractions result;
  for (std::size_t r = 0; r < n; ++r) result.numerators.push_back(std::move(a[r * width + n]));
  result.denominator = std::move(previous);
  return result;
}

}  // namespace delone::kernel
