// SPDX-License-Identifier: BSD-3-Clause
// Keys of vertices, such that the sum of the keys of k vertices tells which they are.
#pragma once

#include <cstdint>

namespace delone::engine {

/// Vertices are numbers. Let p > k be a prime beyond all of them. Digit j of a key, j = 1 … k, to base
/// k(p − 1) + 1, is the jth power of the number modulo p. Sums of k keys have no carries, so their digits
/// tell the sums of the first k powers modulo p. As p > k, these determine by Newton's identities the
/// polynomial with the numbers as its roots, and so the numbers: different sets have different sums. Where
/// the digits do not fit one word, they are divided among two.
template <int K>
class FacetKeys {
  static_assert(K >= 1);

 public:
  /// For numbers below the prime, in one word or two: sums fit 63 bits.
  static constexpr std::uint64_t prime(int words) { return words == 1 ? of_one : of_two; }
  /// The digits of a number in word 0 or 1 of one word or two. REQUIRES that it is below the prime.
  static constexpr std::uint64_t word(std::uint64_t number, int words, int which) {
    return digits(number, prime(words), which == 0 ? 1 : in_first_of_two + 1,
                  words == 2 && which == 0 ? in_first_of_two : K);
  }
  /// A word with powers first … last modulo p as its digits.
  static constexpr std::uint64_t digits(std::uint64_t number, std::uint64_t p, int first, int last) {
    std::uint64_t power = 1, place = 1, word = 0;
    for (int j = 1; j <= last; ++j) {
      power = power * number % p;
      if (j < first) continue;
      word += power * place;
      place *= base(p);
    }
    return word;
  }

 private:
  static constexpr std::uint64_t base(std::uint64_t p) { return static_cast<std::uint64_t>(K) * (p - 1) + 1; }
  static constexpr bool do_fit(std::uint64_t p, int num_digits) {
    std::uint64_t left = std::uint64_t{1} << 63;
    for (int i = 0; i < num_digits; ++i) left /= base(p);
    return left > 0;
  }
  static constexpr bool is_prime(std::uint64_t n) {
    for (std::uint64_t d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return n > 1;
  }
  /// The largest prime below 2^20 for which so many digits fit.
  static constexpr std::uint64_t largest_prime(int num_digits) {
    std::uint64_t p = 1;
    for (std::uint64_t bit = std::uint64_t{1} << 19; bit != 0; bit /= 2)
      if (do_fit(p + bit, num_digits)) p += bit;
    while (!is_prime(p)) --p;
    return p;
  }

  static constexpr int in_first_of_two = (K + 1) / 2;
  static constexpr std::uint64_t of_one = largest_prime(K), of_two = largest_prime(in_first_of_two);
  static_assert(of_one > K && of_two > K);
};

}  // namespace delone::engine
