// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/zero_by_primes.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/miller_rabin.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace delone::kernel {
namespace {

using Matrix = std::vector<Int128>;

Int128 random_entry(std::mt19937_64& random, int bits) {
  Int128 x(0);
  for (int i = 0; i < bits; i += 16) x = x * Int128(1 << 16) + Int128(static_cast<int>(random() & 0xffff));
  return random() % 2 ? x : Int128(-x);
}

/// n rows, the last of which is a combination of the others, and is off by `off` in one place.
Matrix dependent(std::size_t n, int bits, const Int128& off, std::mt19937_64& random) {
  Matrix a(n * n, Int128(0));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const int factor = static_cast<int>(random() % 15) - 7;
    for (std::size_t c = 0; c < n; ++c) {
      a[i * n + c] = random_entry(random, bits);
      a[(n - 1) * n + c] += a[i * n + c] * Int128(factor);
    }
  }
  a[n * n - 1 - random() % n] += off;
  return a;
}

TEST(ZeroByPrimes, ProvesWhatIsZero) {
  std::mt19937_64 random(1);
  for (std::size_t n = 2; n <= 14; ++n)
    for (const int bits : {16, 48, 96}) {
      const double bound = static_cast<double>(n) * (bits + 20);
      EXPECT_TRUE(is_zero_by_primes(dependent(n, bits, Int128(0), random), static_cast<int>(n), bound));
      EXPECT_FALSE(is_zero_by_primes(dependent(n, bits, Int128(1), random), static_cast<int>(n), bound));
      EXPECT_FALSE(is_zero_by_primes(dependent(n, bits, Int128(-1), random), static_cast<int>(n), bound));
    }
}

// A determinant that one prime divides, and two: more primes are asked than divide it.
TEST(ZeroByPrimes, SeesMultiplesOfSomePrimes) {
  const Int128 first = Int128(1) * Int128(std::int64_t{1} << 62) - Int128(57), second = first - Int128(30);
  const Matrix of_one{first, Int128(0), Int128(0), Int128(1)}, of_two{first, Int128(0), Int128(0), second};
  EXPECT_FALSE(is_zero_by_primes(of_one, 2, 64));
  EXPECT_FALSE(is_zero_by_primes(of_two, 2, 126));
}

TEST(ZeroByPrimes, LargeEntriesOfBothSigns) {
  Int128 large(1);
  for (int i = 0; i < 125; ++i) large *= Int128(2);
  const Matrix zero{large, Int128(-large), Int128(-large), large}, other{large, large, Int128(-large), large};
  EXPECT_TRUE(is_zero_by_primes(zero, 2, 252));
  EXPECT_FALSE(is_zero_by_primes(other, 2, 252));
}

TEST(ZeroByPrimes, DoesNotProveMoreThanItsPrimesCan) {
  const Matrix zero(4, Int128(1));
  EXPECT_TRUE(is_zero_by_primes(zero, 2, 3900));
  EXPECT_FALSE(is_zero_by_primes(zero, 2, 4000));
}

TEST(ZeroByPrimes, HasPrimes) {
  std::mt19937 random(2);
  int primes = 0;
  for (std::uint64_t gap = 1; gap <= 2421; gap += 2)
    primes += boost::multiprecision::miller_rabin_test(
                  boost::multiprecision::cpp_int((std::uint64_t{1} << 62) - gap), 25, random)
                  ? 1
                  : 0;
  EXPECT_EQ(primes, 64);
}

}  // namespace
}  // namespace delone::kernel
