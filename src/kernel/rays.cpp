// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/rays.hpp"

#include "kernel/binary.hpp"
#include "kernel/int128.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace delone::kernel {
namespace {

/// x·y without error: magnitude·2^exponent, magnitude < 2^106, with the sign of the product.
struct Product {
  Int128 magnitude;
  int exponent;
  int sign;
};
Product product(double x, double y) {
  const Binary a = decompose(x), b = decompose(y);
  const Int128 mantissa = static_cast<Int128>(a.mantissa) * b.mantissa;
  return {mantissa < 0 ? Int128(-mantissa) : mantissa, a.exponent + b.exponent,
          mantissa < 0   ? -1
          : mantissa > 0 ? 1
                         : 0};
}

std::strong_ordering compare_magnitudes(Product a, Product b) {
  const auto width = [](const Int128& m) -> int {
    const auto [low, high] = magnitude(m);
    return 128 - (high != 0 ? std::countl_zero(high) : 64 + std::countl_zero(low));
  };
  if (const auto top = width(a.magnitude) + a.exponent <=> width(b.magnitude) + b.exponent; top != 0)
    return top;
  // The leading bits have one value: the exponents differ by no more than the widths do, and a shift by that
  // stays below 2^106.
  if (a.exponent > b.exponent) a.magnitude <<= a.exponent - b.exponent;
  if (b.exponent > a.exponent) b.magnitude <<= b.exponent - a.exponent;
  return a.magnitude < b.magnitude   ? std::strong_ordering::less
         : b.magnitude < a.magnitude ? std::strong_ordering::greater
                                     : std::strong_ordering::equal;
}

std::strong_ordering compare(const Product& a, const Product& b) {
  if (a.sign != b.sign) return a.sign <=> b.sign;
  if (a.sign == 0) return std::strong_ordering::equal;
  return a.sign > 0 ? compare_magnitudes(a, b) : compare_magnitudes(b, a);
}

}  // namespace

std::strong_ordering compare_rays(const double* a, const double* b, int size) {
  const auto last_nonzero = [size](const double* row) {
    int j = size - 1;
    while (j > 0 && row[j] == 0) --j;
    return j;
  };
  const int last = last_nonzero(a);
  if (const auto index = last <=> last_nonzero(b); index != 0) return index;
  if ((a[last] < 0) != (b[last] < 0))
    return a[last] < 0 ? std::strong_ordering::less : std::strong_ordering::greater;
  const double a_unit = std::fabs(a[last]), b_unit = std::fabs(b[last]);
  for (int j = 0; j < last; ++j)  // a_j/a_unit against b_j/b_unit
    if (const auto entry = compare(product(a[j], b_unit), product(b[j], a_unit)); entry != 0) return entry;
  return std::strong_ordering::equal;
}

}  // namespace delone::kernel
