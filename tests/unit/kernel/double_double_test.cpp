// SPDX-License-Identifier: BSD-3-Clause
// The bounds of sums and products of pairs, against exact integers.
#include "kernel/double_double.hpp"

#include "base/random.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delone::kernel {
namespace {

constexpr int lowest = -2200;  // exponents of the integers that sums and products are compared in

test::Integer exact(const DoubleDouble& x) { return integer_at(x.high, lowest) + integer_at(x.low, lowest); }

/// The second of two numbers may nearly cancel the first.
DoubleDouble random_number(random::Generator& generator, const DoubleDouble& other) {
  const double high = random_double(generator, 80);
  switch (generator.below(4)) {
    case 0:
      return two_sum(-other.high, random_double(generator, 2) * std::ldexp(other.high, -53));
    case 1:
      return two_sum(std::nextafter(-other.high, 1e300), std::ldexp(high, -160));
    case 2:
      return {high, 0};
    default:
      return two_sum(high, std::ldexp(high * generator.uniform(), -50));
  }
}

TEST(DoubleDouble, SumsAndProductsKeepTheirBounds) {
  random::Generator generator(5);
  for (std::size_t round = 0; round < test::scaled_count(40000); ++round) {
    const DoubleDouble x = random_number(generator, {1, 0}), y = random_number(generator, x);
    const test::Integer a = exact(x), b = exact(y);
    for (const DoubleDouble& z : {x + y, x - y, x * y}) {
      EXPECT_EQ(z.high, z.high + z.low);
      EXPECT_LE(std::fabs(z.low), 0x1p-53 * std::fabs(z.high));
    }
    // 6u² and 9u², u² = 2^−106
    EXPECT_LE(abs(exact(x + y) - (a + b)) << 106, 6 * (abs(a) + abs(b)));
    EXPECT_LE(abs(exact(x - y) - (a - b)) << 106, 6 * (abs(a) + abs(b)));
    EXPECT_LE(abs(shifted(exact(x * y), -lowest) - a * b) << 106, 9 * abs(a * b));
  }
}

TEST(DoubleDouble, SumsAreBoundedAmongDenormalNumbers) {
  random::Generator generator(6);
  for (std::size_t round = 0; round < test::scaled_count(20000); ++round) {
    const auto tiny = [&] {
      return std::ldexp(2 * generator.uniform() - 1, -960 - static_cast<int>(generator.below(110)));
    };
    const DoubleDouble x = two_sum(tiny(), tiny()), y = two_sum(tiny(), tiny());
    const test::Integer a = exact(x), b = exact(y);
    EXPECT_LE(abs(exact(x + y) - (a + b)) << 106, 6 * (abs(a) + abs(b)));
    // A product of this size may be off by less than 2^−890, and stays a number with a small low part.
    const DoubleDouble product = DoubleDouble{std::ldexp(x.high, 300), std::ldexp(x.low, 300)} *
                                 DoubleDouble{std::ldexp(y.high, 200), std::ldexp(y.low, 200)};
    EXPECT_LE(std::fabs(product.high), 0x1p-890);
    EXPECT_LE(std::fabs(product.low), 0x1p-53 * std::fabs(product.high));
  }
}

}  // namespace
}  // namespace delone::kernel
