// SPDX-License-Identifier: BSD-3-Clause
// Greatest common divisors of all sizes, against those of Boost.
#include "polyhedra/common_divisor.hpp"

#include "cone_support.hpp"

#include <gtest/gtest.h>

namespace delone::polyhedra {
namespace {

TEST(CommonDivisor, Of128Bits) {
  random::Generator generator(4);
  for (int round = 0; round < 2000; ++round) {
    const Integer common = abs(random_integer(generator, Integer(1) << generator.below(60)));
    const Integer a = common * abs(random_integer(generator, Integer(1) << generator.below(60))),
                  b = common * abs(random_integer(generator, Integer(1) << generator.below(60)));
    EXPECT_EQ(Integer(common_divisor(static_cast<Int128>(a), static_cast<Int128>(b))),
              Integer(boost::multiprecision::gcd(a, b)));
  }
}

TEST(CommonDivisor, OfAnySize) {
  random::Generator generator(5);
  for (int round = 0; round < 5000; ++round) {
    const auto factor = [&] { return random_integer(generator, Integer(1) << generator.below(360)); };
    const Integer common = generator.below(3) == 0 ? Integer(1) : factor(), x = factor(), y = factor();
    const Integer a = common * x, b = generator.below(10) == 0 ? common * x * y : common * y;
    EXPECT_EQ(common_divisor(a, b), Integer(boost::multiprecision::gcd(a, b))) << a << ' ' << b;
  }
}

/// Quotients that are all 1, one that is huge, and numbers that agree in their leading digits.
TEST(CommonDivisor, OfExtremes) {
  Integer a = 1, b = 1;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(common_divisor(6 * a, 6 * b), 6);
    a += b;
    a.swap(b);
  }
  const Integer large = Integer(1) << 600;
  EXPECT_EQ(common_divisor(large * 15, Integer(10)), 10);
  EXPECT_EQ(common_divisor(large, Integer(large - 1)), 1);
  EXPECT_EQ(common_divisor(Integer(large * 9), Integer(9 * (large + 1))), 9);
  EXPECT_EQ(common_divisor(large, large), large);
  EXPECT_EQ(common_divisor(Integer(0), Integer(-large)), large);
  EXPECT_EQ(common_divisor(Integer(0), Integer(0)), 0);
}

}  // namespace
}  // namespace delone::polyhedra
