// SPDX-License-Identifier: BSD-3-Clause
#include "base/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace delone::random {
namespace {

// The numbers that the reference implementations give.
TEST(Random, MixIsTheOutputOfSplitmix64) {
  std::uint64_t seed = 1234567;
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u})
    EXPECT_EQ(mix(seed += 0x9e3779b97f4a7c15u), expected);
}

TEST(Random, BitsAreThoseOfXoshiro256PlusPlus) {
  Generator generator(0);
  for (const std::uint64_t expected :
       {5987356902031041503u, 7051070477665621255u, 6633766593972829180u, 211316841551650330u})
    EXPECT_EQ(generator.bits(), expected);
}

TEST(Random, BelowIsInRangeAndUniform) {
  Generator generator(1);
  EXPECT_EQ(generator.below(1), 0u);
  // A bias shows most for bounds just above half of a power of two.
  for (const std::uint64_t bound :
       {std::uint64_t{3}, std::uint64_t{0x80000001}, std::uint64_t{0xffffffff}, std::uint64_t{0x100000001},
        std::uint64_t{0x8000000000000001}, ~std::uint64_t{0}}) {
    std::array<int, 3> thirds{};
    constexpr int draws = 30'000;
    for (int i = 0; i < draws; ++i) {
      const std::uint64_t value = generator.below(bound);
      ASSERT_LT(value, bound);
      ++thirds[value / (bound / 3 + (bound % 3 != 0))];
    }
    for (const int count : thirds) EXPECT_NEAR(count, draws / 3, 500) << bound;  // six standard deviations
  }
}

TEST(Random, UniformNumbersAreMultiplesOfTheUnitRoundoffBelowOne) {
  Generator generator(2);
  double sum = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double x = generator.uniform();
    ASSERT_TRUE(x >= 0 && x < 1);
    ASSERT_EQ(x * 0x1p53, std::floor(x * 0x1p53));
    sum += x;
  }
  EXPECT_NEAR(sum, 5000, 200);
}

TEST(Random, CoinsAreFair) {
  Generator generator(3);
  int heads = 0;
  for (int i = 0; i < 10'000; ++i) heads += generator.coin();
  EXPECT_NEAR(heads, 5000, 300);
}

static_assert(Generator(7).bits() == Generator(7).bits() && Generator(7).bits() != Generator(8).bits());

}  // namespace
}  // namespace delone::random
