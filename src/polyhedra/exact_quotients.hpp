// SPDX-License-Identifier: BSD-3-Clause
// Combinations of two rays, divided by a number that is expected to divide them. No greatest common divisor
// is computed: the quotients are found modulo 2^128, by the inverse of the divisor there, and multiplied
// back.
#pragma once

#include "kernel/int128.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace delone::polyhedra {

#if DELONE_HAS_INT128

/// An integer modulo 2^256, in two's complement.
struct Int256 {
  using Word = internal::BuiltInUInt128;
  Word low, high;
  friend bool operator==(const Int256&, const Int256&) = default;
};

inline Int256 product_256(kernel::Int128 a, kernel::Int128 b) {
  using Word = Int256::Word;
  constexpr Word half = ~std::uint64_t{0};
  const Word x = static_cast<Word>(a), y = static_cast<Word>(b);
  const Word x0 = x & half, x1 = x >> 64, y0 = y & half, y1 = y >> 64;
  const Word low = x0 * y0, one = x1 * y0 + (low >> 64), other = x0 * y1 + (one & half);
  Int256 result{(other << 64) | (low & half), x1 * y1 + (one >> 64) + (other >> 64)};
  if (a < 0) result.high -= y;
  if (b < 0) result.high -= x;
  return result;
}

inline Int256 sum_256(const Int256& a, const Int256& b) {
  Int256 sum{a.low + b.low, a.high + b.high};
  if (sum.low < a.low) ++sum.high;
  return sum;
}

/// Division by one positive number.
class ExactDivisor {
 public:
  using Word = Int256::Word;

  explicit ExactDivisor(kernel::Int128 divisor) : divisor_(divisor) {
    const auto d = static_cast<Word>(divisor);
    const auto low = static_cast<std::uint64_t>(d);
    shift_ = low != 0 ? std::countr_zero(low) : 64 + std::countr_zero(static_cast<std::uint64_t>(d >> 64));
    // Newton's iteration (Warren, "Hacker's Delight", 2012, 10-16): 5 bits, 10, 20, 40, 80, 160.
    const Word odd = d >> shift_;
    inverse_ = 3 * odd ^ 2;
    for (int i = 0; i < 5; ++i) inverse_ *= 2 - odd * inverse_;
  }

  /// quotient = x/divisor, if this is an integer of 128 bits: the quotient modulo 2^128 is right then, and
  /// otherwise no number of 128 bits times the divisor is x.
  bool try_divide(const Int256& x, kernel::Int128& quotient) const {
    Word low = x.low;
    if (shift_ > 0) low = (x.low >> shift_) | (x.high << (128 - shift_));
    quotient = static_cast<kernel::Int128>(low * inverse_);
    return product_256(quotient, divisor_) == x;
  }

 private:
  kernel::Int128 divisor_;
  int shift_;
  Word inverse_;
};

/// out[i] = (at_p·n[i] + at_n·p[i])/divisor, if all of these are integers below 2^most_bits. REQUIRES entries
/// and factors below 2^126, and divisor > 0. `out` is unspecified if it says no.
template <class T>
bool try_exact_quotients(const T* p, const T* n, kernel::Int128 at_p, kernel::Int128 at_n,
                         kernel::Int128 divisor, std::size_t d, int most_bits, T* out) {
  const ExactDivisor by(divisor);
  const kernel::Int128 limit = kernel::Int128{1} << most_bits;
  for (std::size_t i = 0; i < d; ++i) {
    kernel::Int128 quotient;
    if (!by.try_divide(sum_256(product_256(at_p, n[i]), product_256(at_n, p[i])), quotient)) return false;
    if (quotient >= limit || quotient <= -limit) return false;
    out[i] = static_cast<T>(quotient);
  }
  return true;
}

#else

/// Without integers of 128 bits in the language a greatest common divisor is no slower.
template <class T>
bool try_exact_quotients(const T*, const T*, const kernel::Int128&, const kernel::Int128&,
                         const kernel::Int128&, std::size_t, int, T*) {
  return false;
}

#endif

}  // namespace delone::polyhedra
